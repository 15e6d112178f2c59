// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/loop/wiring.hpp>
#include <limpid/loop/wiring_errors.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/tuple.hpp>
#include <boost/hana/type.hpp>

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace limpid::wiring {

template <typename S>
concept HasInitial = requires {
  { S::initial() } -> std::convertible_to<typename S::value_type>;
};

/// Whether the wiring is sound, or the first sentence of `loop_error` that says why not.
/// Signatures and sources are asked only of the blocks that serve what is wanted; two writers are refused even where
/// nobody wants them, since the wants may change.
template <typename Wiring>
class Check {
  using Fine = loop_error::Fine;
  template <std::size_t I>
  using Block = typename Wiring::template Block<I>;

 public:
  template <typename... W, typename... In>
  static constexpr auto verdict(wants<W...>, inputs<In...>) {
    return (Fine{} && ... && wanted<W>()) && (Fine{} && ... && only_input<In>()) &&
           blocks(std::make_index_sequence<Wiring::size>{}) && acyclic();
  }

 private:
  template <std::size_t... I>
  static constexpr auto blocks(std::index_sequence<I...>) {
    return (Fine{} && ... && writes_alone<I>(typename Block<I>::writes{})) && (Fine{} && ... && kept<I>());
  }

  template <std::size_t I>
  static constexpr auto kept() {
    if constexpr (Wiring::kept[I]) {
      using B = Block<I>;
      return has_sources<B>(typename B::reads{}) && Call<B>::verdict() && starts<B>(typename B::writes{});
    } else {
      return Fine{};
    }
  }

  template <typename S>
  static constexpr bool has_source = Wiring::template is_input<S> || count(Wiring::template writers<S>) > 0;

  template <typename S>
  static constexpr auto wanted() {
    if constexpr (has_source<S>) {
      return Fine{};
    } else {
      return loop_error::Verdict<typename loop_error::no_block_writes<S>::which_is_wanted>{};
    }
  }

  template <typename S>
  static constexpr auto only_input() {
    if constexpr (count(Wiring::template writers<S>) == 0) {
      return Fine{};
    } else {
      using Writer = tag_of<typename Wiring::template Writer<S>>;
      return loop_error::Verdict<typename loop_error::the_input<S>::template is_also_written_by<Writer>>{};
    }
  }

  template <std::size_t I>
  static constexpr auto writes_alone(boost::hana::tuple<>) {
    return loop_error::Verdict<typename loop_error::block<tag_of<Block<I>>>::writes_nothing>{};
  }
  template <std::size_t I, typename... S>
  static constexpr auto writes_alone(boost::hana::tuple<S...>) {
    return (Fine{} && ... && writes_alone<I, typename S::type>());
  }
  template <std::size_t I, typename S>
  static constexpr auto writes_alone() {
    constexpr std::size_t other = first_after(Wiring::template writers<S>, I);
    if constexpr (other == Wiring::size) {
      return Fine{};
    } else {
      using Sentence =
          typename loop_error::two_blocks_write<S>::template namely<tag_of<Block<I>>, tag_of<Block<other>>>;
      return loop_error::Verdict<Sentence>{};
    }
  }

  template <typename B, typename... Entries>
  static constexpr auto has_sources(boost::hana::tuple<Entries...>) {
    return (Fine{} && ... && source<B, typename Entries::type>());
  }
  template <typename B, typename Entry>
  static constexpr auto source() {
    using S = typename Reading<Entry>::signal;
    if constexpr (std::is_same_v<Entry, TickStatus>) {
      return Fine{};
    } else if constexpr (!has_source<S>) {
      return loop_error::Verdict<typename loop_error::no_block_writes<S>::template which<tag_of<B>>::reads>{};
    } else if constexpr (Reading<Entry>::previous && !HasInitial<S>) {
      using Because = typename loop_error::signal<S>::needs_a_static_function_initial_because;
      return loop_error::Verdict<typename Because::template it_is_read_as_Previous_by<tag_of<B>>>{};
    } else {
      return Fine{};
    }
  }

  // What a skippable block writes has a value before its first call.
  template <typename B, typename... S>
  static constexpr auto starts(boost::hana::tuple<S...>) {
    return (Fine{} && ... && starts<B, typename S::type>());
  }
  template <typename B, typename S>
  static constexpr auto starts() {
    if constexpr (Call<B>::skippable && !HasInitial<S>) {
      using Because = typename loop_error::signal<S>::needs_a_static_function_initial_because;
      return loop_error::Verdict<typename Because::template its_writer_may_be_skipped<tag_of<B>>>{};
    } else {
      return Fine{};
    }
  }

  static constexpr Row<Wiring::size> path = cycle(Wiring::after, Wiring::kept, Wiring::order);

  static constexpr auto acyclic() {
    if constexpr (path.size == 0) {
      return Fine{};
    } else {
      return around(std::make_index_sequence<path.size>{});
    }
  }
  template <std::size_t... K>
  static constexpr auto around(std::index_sequence<K...>) {
    using Cycle = loop_error::a_cycle<Step<Block<path.block[K]>, Block<path.block[(K + 1) % path.size]>>...>;
    return loop_error::Verdict<typename Cycle::without_Previous>{};
  }

  // What a reader takes from a writer in the same tick.
  template <typename Reader, typename Writer, typename... Entries>
  static constexpr auto taken(boost::hana::tuple<Entries...> entries) {
    return boost::hana::at_c<first(
        Set<sizeof...(Entries)>{contains<typename Writer::writes, typename Entries::type>...})>(entries);
  }
  template <typename Reader, typename Writer>
  using Step = typename loop_error::block<tag_of<Reader>>::template reads<typename decltype(taken<Reader, Writer>(
      typename Reader::reads{}))::type>::template from<tag_of<Writer>>;
};

template <typename Wiring, typename Wants, typename Inputs>
using sentence = typename decltype(Check<Wiring>::verdict(Wants{}, Inputs{}))::sentence;

}  // namespace limpid::wiring
