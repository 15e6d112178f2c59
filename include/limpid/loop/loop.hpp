// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/flat.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/loop/block.hpp>
#include <limpid/loop/check.hpp>
#include <limpid/loop/result.hpp>
#include <limpid/loop/signal.hpp>
#include <limpid/loop/tick.hpp>
#include <limpid/loop/wiring.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/tuple.hpp>

#include <cstddef>
#include <exception>
#include <tuple>
#include <type_traits>
#include <utility>

namespace limpid {

template <typename Wants, typename Inputs, typename... Given>
class Loop;

/// Blocks connected by the signals they read and write; made by `make_loop`. What follows from the types is settled by
/// the compiler: the order of the calls, which blocks serve what is wanted (the others are neither stored nor called),
/// and whether the wiring is sound. `step` then is the sequence of calls that one would write by hand.
///
/// A signal lives for one tick, where its block returned it. Only those read as `Previous` and those of blocks that may
/// be skipped are kept in the loop.
/// @tparam Given  the blocks handed to make_loop, in any order
/// @realtime      step: no allocation and no throw of its own; costs the calls of its blocks, inlined into one function
///                (`flat`)
template <typename... W, typename... In, typename... Given>
class Loop<wants<W...>, inputs<In...>, Given...> {
  using Wiring = wiring::Wiring<wants<W...>, inputs<In...>, Given...>;
  using Sentence = wiring::sentence<Wiring, wants<W...>, inputs<In...>>;
  static constexpr bool sound = loop_error::loop_is_sound<Sentence>;
  static_assert(loop_error::loop_is_sound<Sentence>,
                "limpid: this loop cannot be built; what is wrong stands in loop_is_sound<...>");
  using Calls = std::make_index_sequence<sound ? Wiring::order.size : 0>;

  using Memory = std::conditional_t<sound, wiring::Memory<Wiring, Calls>, std::tuple<>>;

  template <std::size_t... K>
  static constexpr bool nothrow(std::index_sequence<K...>) {
    return (wiring::Call<typename Wiring::template Called<K>>::nothrow && ...);
  }
  template <std::size_t... K>
  static auto stored(std::index_sequence<K...>) -> boost::hana::tuple<typename Wiring::template Called<K>...>;

 public:
  /// The blocks that are stored and called, in the order of the calls.
  using Blocks = decltype(stored(Calls{}));

  /// Whether the block of this type, or made with this tag, is among them.
  template <typename B>
  static constexpr bool has = wiring::contains_tag<Blocks, B>;

  explicit Loop(Given... given) : Loop(Calls{}, std::forward_as_tuple(std::move(given)...)) {}

  /// One tick.
  /// @param now     time of the tick
  /// @param values  of the inputs, in their order; a status among them is joined with those of the blocks
  [[gnu::always_inline]] StepResult<W...> step(Time now,
                                               const typename In::value_type&... values) noexcept(nothrow(Calls{})) {
    if constexpr (sound) {
      const typename Wiring::InputValues inputs{values...};
      const Status heard = (Status::ok | ... | wiring::status_of(values));
      return flat<wiring::WidestScalar<typename In::value_type..., typename W::value_type...>>(
          [&]() noexcept(nothrow(Calls{})) { return ticked(now, inputs, heard); });
    } else {
      std::terminate();  // never compiled without an error
    }
  }

  /// The block of this type, or made with this tag; between two ticks.
  template <typename B>
  requires has<B>
  [[nodiscard]] auto& block() noexcept { return boost::hana::at_c<wiring::index_of_tag<Blocks, B>>(blocks_); }
  template <typename B>
  requires has<B>
  [[nodiscard]] const auto& block() const noexcept {
    return boost::hana::at_c<wiring::index_of_tag<Blocks, B>>(blocks_);
  }

 private:
  template <std::size_t... K, typename Tuple>
  Loop(std::index_sequence<K...>, Tuple&& given)
      : blocks_(std::get<Wiring::order.block[K]>(std::forward<Tuple>(given))...) {}

  [[gnu::always_inline]] StepResult<W...> ticked(Time now, const typename Wiring::InputValues& inputs,
                                                 const Status& heard) noexcept(nothrow(Calls{})) {
    const wiring::Tick<Wiring, Blocks, Memory> tick{blocks_, memory_, now};
    return tick.template run<0>(
        {inputs}, heard, [&](const auto& seen, const Status& status) __attribute__((always_inline)) {
          (remember<In>(tick, seen), ...);
          remember(tick, seen, Calls{});
          return StepResult<W...>{{tick.template value<W>(seen, status)}..., status};
        });
  }

  template <typename S, typename Tick, typename Seen>
  [[gnu::always_inline]] void remember(const Tick& tick, const Seen& seen) {
    if constexpr (Wiring::template is_read_later<S>) {
      static_cast<wiring::LastTick<S, true>&>(memory_).value = tick.template value<S>(seen, Status::ok);
    }
  }
  template <typename Tick, typename Seen, typename... S>
  [[gnu::always_inline]] void remember_all(const Tick& tick, const Seen& seen, boost::hana::tuple<S...>) {
    (remember<typename S::type>(tick, seen), ...);
  }
  template <typename Tick, typename Seen, std::size_t... K>
  [[gnu::always_inline]] void remember(const Tick& tick, const Seen& seen, std::index_sequence<K...>) {
    (remember_all(tick, seen, typename Wiring::template Called<K>::writes{}), ...);
  }

  [[no_unique_address]] Blocks blocks_;
  [[no_unique_address]] Memory memory_;
};

/// Connects blocks, given in any order, to a loop:
/// ```cpp
/// auto loop = make_loop<wants<SafeTorque>, inputs<OperatorForce, JointState>>(sampling, prediction, tracking, safety);
/// auto [torque, status] = loop.step(now, F_h, joints);
/// ```
/// Wrong wiring does not compile; see limpid/loop/wiring_errors.hpp.
template <typename Wants, typename Inputs, Block... Given>
[[nodiscard]] auto make_loop(Given... given) {
  return Loop<Wants, Inputs, Given...>(std::move(given)...);
}

}  // namespace limpid
