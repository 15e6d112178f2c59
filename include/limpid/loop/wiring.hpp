// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/loop/call.hpp>
#include <limpid/loop/graph.hpp>
#include <limpid/loop/signal.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/tuple.hpp>
#include <boost/hana/type.hpp>

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace limpid::wiring {

// Folds over the types of a Hana tuple; hana::contains and hana::any_of say the same in twice the compile time.
template <typename List, typename S>
inline constexpr bool contains = false;
template <typename... T, typename S>
inline constexpr bool contains<boost::hana::tuple<T...>, S> = (std::is_same_v<typename T::type, S> || ...);

template <typename List, std::size_t I>
using element = typename std::remove_cvref_t<decltype(boost::hana::at_c<I>(std::declval<const List&>()))>::type;

// An entry of a block's `reads`, taken apart.
template <typename Entry>
struct Reading {
  using signal = Entry;
  static constexpr bool previous = false;
};
template <typename S>
struct Reading<Previous<S>> {
  using signal = S;
  static constexpr bool previous = true;
};

// Whether a signal of one list is read from the other, in the same tick or also as Previous.
template <bool EvenPrevious, typename Reads, typename Writes>
inline constexpr bool reads_from = false;
template <typename... R, typename Writes>
inline constexpr bool reads_from<false, boost::hana::tuple<R...>, Writes> = (contains<Writes, typename R::type> || ...);
template <typename... R, typename Writes>
inline constexpr bool reads_from<true, boost::hana::tuple<R...>, Writes> =
    (contains<Writes, typename Reading<typename R::type>::signal> || ...);

template <bool EvenPrevious, typename Reader, typename... Writers>
constexpr Set<sizeof...(Writers)> sources() noexcept {
  return {reads_from<EvenPrevious, typename Reader::reads, typename Writers::writes>...};
}

template <bool EvenPrevious, typename... Blocks>
inline constexpr Relation<sizeof...(Blocks)> reads_relation{sources<EvenPrevious, Blocks, Blocks...>()...};

template <typename List, typename... S>
inline constexpr bool contains_any = (contains<List, S> || ...);

// A block in a Hana tuple of blocks, by its tag.
template <typename Blocks, typename Tag>
inline constexpr std::size_t index_of_tag = 0;
template <typename... B, typename Tag>
inline constexpr std::size_t index_of_tag<boost::hana::tuple<B...>, Tag> = first(Set<sizeof...(B)>{
    (std::is_same_v<B, Tag> || std::is_same_v<tag_of<B>, Tag>)...});

template <typename Blocks, typename Tag>
inline constexpr bool contains_tag = false;
template <typename... B, typename Tag>
inline constexpr bool contains_tag<boost::hana::tuple<B...>, Tag> =
    ((std::is_same_v<B, Tag> || std::is_same_v<tag_of<B>, Tag>) || ...);

/// Who is called, and when; all of it known from the types.
template <typename Wants, typename Inputs, typename... Blocks>
struct Wiring;

template <typename... W, typename... In, typename... Blocks>
struct Wiring<wants<W...>, inputs<In...>, Blocks...> {
  static constexpr std::size_t size = sizeof...(Blocks);
  template <std::size_t I>
  using Block = element<boost::hana::tuple<boost::hana::type<Blocks>...>, I>;
  using Inputs = boost::hana::tuple<boost::hana::type<In>...>;
  using InputValues = std::tuple<const typename In::value_type&...>;

  static constexpr Set<size> wanted{contains_any<typename Blocks::writes, W...>...};
  static constexpr Set<size> kept = reach(reads_relation<true, Blocks...>, wanted);
  static constexpr Relation<size> after =
      put_last(reads_relation<false, Blocks...>, kept, {contains<typename Blocks::reads, TickStatus>...});
  static constexpr Row<size> order = sorted(after, kept);
  template <std::size_t K>
  using Called = Block<order.block[K]>;

  template <typename S>
  static constexpr bool is_input = contains<Inputs, S>;
  template <typename S>
  static constexpr Set<size> writers{contains<typename Blocks::writes, S>...};
  template <typename S>
  using Writer = Block<first(writers<S>)>;
  /// How many blocks have been called when the signal is written.
  template <typename S>
  static constexpr std::size_t written_after = 1 + position(order, first(writers<S>));
  /// Whether a kept block reads it as Previous.
  template <typename S>
  static constexpr bool is_read_later = meet(kept, Set<size>{contains<typename Blocks::reads, Previous<S>>...});
};

}  // namespace limpid::wiring
