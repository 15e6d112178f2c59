// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/loop/call.hpp>
#include <limpid/loop/wiring.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/tuple.hpp>

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace limpid::wiring {

// What outlives a tick; empty where it need not.
template <typename S, bool>
struct LastWritten {};
template <typename S>
struct LastWritten<S, true> {
  typename S::value_type value = S::initial();
};
template <typename S, bool>
struct LastTick {};
template <typename S>
struct LastTick<S, true> {
  typename S::value_type value = S::initial();
};

template <typename Wiring, bool Skippable, typename List>
struct Slots;
template <typename Wiring, bool Skippable, typename... S>
struct Slots<Wiring, Skippable, boost::hana::tuple<S...>>
    : LastWritten<typename S::type, Skippable>...,
      LastTick<typename S::type, Wiring::template is_read_later<typename S::type>>... {};

/// For `flat`: the scalar of one of these values that is a class, where there is one, else double.
template <typename... Values>
struct Widest {
  using type = double;
};
template <typename Value, typename... Rest>
struct Widest<Value, Rest...> : Widest<Rest...> {};
template <typename Value, typename... Rest>
requires std::is_class_v<typename Value::Scalar>
struct Widest<Value, Rest...> {
  using type = typename Value::Scalar;
};
template <typename... Values>
using WidestScalar = typename Widest<Values...>::type;

/// The signals that outlive a tick: those of skippable blocks, and those read as Previous.
template <typename Wiring, typename Calls>
struct Memory;
template <typename Wiring, std::size_t... K>
struct Memory<Wiring, std::index_sequence<K...>> : Slots<Wiring, Call<typename Wiring::template Called<K>>::skippable,
                                                         typename Wiring::template Called<K>::writes>...,
                                                   Slots<Wiring, false, typename Wiring::Inputs> {};

/// What the first K blocks of a tick returned, and the inputs, by reference: every output is built where its block
/// returns it, a local variable as in a sequence of calls by hand, and read from there.
template <typename Wiring, std::size_t K>
struct Seen;

template <typename Wiring>
struct Seen<Wiring, 0> {
  const typename Wiring::InputValues& inputs;
};

template <typename Wiring, std::size_t K>
requires(K > 0 && !Call<typename Wiring::template Called<K - 1>>::skippable) struct Seen<Wiring, K>
    : Seen<Wiring, K - 1> {
  using Output = std::remove_reference_t<typename Call<typename Wiring::template Called<K - 1>>::Returned>;
  const Output& output;
};

template <typename Wiring, std::size_t K>
requires(K > 0 && Call<typename Wiring::template Called<K - 1>>::skippable) struct Seen<Wiring, K>
    : Seen<Wiring, K - 1> {
};

/// One tick on its way through the blocks; its recursion is inlined to the sequence of calls.
template <typename Wiring, typename Blocks, typename Memory>
struct Tick {
  Blocks& blocks;
  Memory& memory;
  Time now;

  /// Calls the blocks from the K-th on, then `finish` with all that was seen and the joined status.
  template <std::size_t K, typename Finish>
  [[gnu::always_inline]] auto run(const Seen<Wiring, K>& seen, const Status& status, const Finish& finish) const {
    if constexpr (K == Wiring::order.size) {
      return finish(seen, status);
    } else if constexpr (Call<typename Wiring::template Called<K>>::skippable) {
      return run<K + 1>({seen}, status | call_if_active<K>(seen, status), finish);
    } else {
      using Block = typename Wiring::template Called<K>;
      decltype(auto) output = call<K>(seen, status, typename Block::reads{});
      return run<K + 1>({seen, output}, status | Call<Block>::status(output), finish);
    }
  }

  /// The value of a signal or of an entry of a block's `reads`.
  template <typename Entry, std::size_t K>
  [[gnu::always_inline]] const auto& value(const Seen<Wiring, K>& seen, const Status& status) const noexcept {
    using S = typename Reading<Entry>::signal;
    if constexpr (std::is_same_v<S, TickStatus>) {
      return status;
    } else if constexpr (Reading<Entry>::previous) {
      return static_cast<const LastTick<S, true>&>(memory).value;
    } else if constexpr (Wiring::template is_input<S>) {
      return std::get<index<typename Wiring::Inputs, S>>(seen.inputs);
    } else if constexpr (Call<typename Wiring::template Writer<S>>::skippable) {
      return static_cast<const LastWritten<S, true>&>(memory).value;
    } else {
      const auto& output = static_cast<const Seen<Wiring, Wiring::template written_after<S>>&>(seen).output;
      return Call<typename Wiring::template Writer<S>>::template written<S>(output);
    }
  }

 private:
  template <std::size_t K, typename... Entries>
  [[gnu::always_inline]] decltype(auto) call(const Seen<Wiring, K>& seen, const Status& status,
                                             boost::hana::tuple<Entries...>) const {
    return boost::hana::at_c<K>(blocks)(now, value<typename Entries::type>(seen, status)...);
  }
  template <std::size_t K, typename... Entries>
  [[gnu::always_inline]] bool is_active(const Seen<Wiring, K>& seen, const Status& status,
                                        boost::hana::tuple<Entries...>) const {
    return std::as_const(boost::hana::at_c<K>(blocks)).active(now, value<typename Entries::type>(seen, status)...);
  }

  template <std::size_t K>
  [[gnu::always_inline]] Status call_if_active(const Seen<Wiring, K>& seen, const Status& status) const {
    using Block = typename Wiring::template Called<K>;
    if (!is_active<K>(seen, status, typename Block::reads{})) return Status::ok;
    decltype(auto) output = call<K>(seen, status, typename Block::reads{});
    keep<Block>(output, typename Block::writes{});
    return Call<Block>::status(output);
  }
  template <typename Block, typename Output, typename... S>
  [[gnu::always_inline]] void keep(const Output& output, boost::hana::tuple<S...>) const {
    ((static_cast<LastWritten<typename S::type, true>&>(memory).value =
          Call<Block>::template written<typename S::type>(output)),
     ...);
  }
};

}  // namespace limpid::wiring
