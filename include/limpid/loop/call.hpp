// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/time.hpp>
#include <limpid/loop/block.hpp>
#include <limpid/loop/graph.hpp>
#include <limpid/loop/signal.hpp>
#include <limpid/loop/wiring_errors.hpp>

#include <boost/hana/tuple.hpp>

#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace limpid::wiring {

// Where a signal stands in a list.
template <typename List, typename S>
inline constexpr std::size_t index = 0;
template <typename... T, typename S>
inline constexpr std::size_t index<boost::hana::tuple<T...>, S> = first(Set<sizeof...(T)>{
    std::is_same_v<typename T::type, S>...});

template <typename B, typename... Values>
concept CalledWith = std::is_invocable_v<B&, Time, const Values&...>;

template <typename B, typename... Values>
concept SkippableWith = requires(const B& block, Time now, const Values&... values) {
  { block.active(now, values...) } -> std::same_as<bool>;
};

template <typename B>
concept NamesActive = requires {
  &B::active;
};

/// How a block is called, and whether its signature fits the signals it names.
template <typename B, typename Reads = typename B::reads, typename Writes = typename B::writes>
struct Call;

template <typename B, typename... R, typename... W>
struct Call<B, boost::hana::tuple<R...>, boost::hana::tuple<W...>> {
  static constexpr bool callable = CalledWith<B, typename R::type::value_type...>;
  static constexpr bool skippable = SkippableWith<B, typename R::type::value_type...>;
  using Returned =
      typename std::conditional_t<callable, std::invoke_result<B&, Time, const typename R::type::value_type&...>,
                                  std::type_identity<void>>::type;

  static constexpr bool nothrow = [] {
    if constexpr (skippable) {
      if (!noexcept(std::declval<const B&>().active(Time{}, std::declval<const typename R::type::value_type&>()...))) {
        return false;
      }
    }
    return std::is_nothrow_invocable_v<B&, Time, const typename R::type::value_type&...>;
  }();

  /// The value of a signal in what the block returned.
  template <typename S, typename Output>
  [[gnu::always_inline]] static constexpr const typename S::value_type& written(const Output& output) noexcept {
    if constexpr (sizeof...(W) == 1) {
      return carried<typename S::value_type>(output);
    } else {
      return carried<typename S::value_type>(std::get<index<boost::hana::tuple<W...>, S>>(output));
    }
  }

  template <typename Output>
  [[gnu::always_inline]] static constexpr Status status(const Output& output) noexcept {
    if constexpr (sizeof...(W) == 1) {
      return status_of(output);
    } else {
      return std::apply([](const auto&... part) { return (Status::ok | ... | status_of(part)); }, output);
    }
  }

  /// Whether the signature fits the signals.
  static constexpr auto verdict() {
    using Blame = loop_error::block<tag_of<B>>;
    if constexpr (!callable) {
      return loop_error::Verdict<
          typename Blame::template cannot_be_called_with<Time, typename R::type::value_type...>>{};
    } else if constexpr (NamesActive<B> && !skippable) {
      return loop_error::Verdict<
          typename Blame::template has_an_active_that_cannot_be_called_with<Time, typename R::type::value_type...>>{};
    } else if constexpr (!carries()) {
      return loop_error::Verdict<
          typename Blame::template returns<Returned>::template instead_of<typename W::type::value_type...>>{};
    } else {
      return loop_error::Fine{};
    }
  }

 private:
  static constexpr bool carries() {
    using Output = std::remove_cvref_t<Returned>;
    if constexpr (sizeof...(W) == 1) {
      return (Carries<typename W::type::value_type, Output> && ...);
    } else if constexpr (requires { std::tuple_size<Output>::value; }) {
      if constexpr (std::tuple_size_v<Output> == sizeof...(W)) {
        return carries<Output>(std::index_sequence_for<W...>{});
      }
    }
    return false;
  }
  template <typename Output, std::size_t... I>
  static constexpr bool carries(std::index_sequence<I...>) {
    return (Carries<typename W::type::value_type, std::tuple_element_t<I, Output>> && ...);
  }
};

}  // namespace limpid::wiring
