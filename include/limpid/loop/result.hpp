// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/status.hpp>
#include <limpid/loop/signal.hpp>

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace limpid {

namespace wiring {

template <typename S>
struct Wanted {
  typename S::value_type value;
};

}  // namespace wiring

/// What a tick gave: the wanted signals in their order and the joined status.
/// `auto [torque, status] = loop.step(...)`, or `result.get<SafeTorque>()`, `result.status`.
template <typename... S>
struct StepResult : wiring::Wanted<S>... {
  Status status;

  template <typename Signal>
  [[nodiscard]] constexpr const typename Signal::value_type& get() const noexcept {
    return static_cast<const wiring::Wanted<Signal>&>(*this).value;
  }

  template <std::size_t I>
  [[nodiscard]] constexpr const auto& get() const noexcept {
    if constexpr (I == sizeof...(S)) {
      return status;
    } else {
      return get<std::tuple_element_t<I, std::tuple<S...>>>();
    }
  }
};

}  // namespace limpid

template <typename... S>
struct std::tuple_size<limpid::StepResult<S...>> : std::integral_constant<std::size_t, sizeof...(S) + 1> {};

template <std::size_t I, typename... S>
struct std::tuple_element<I, limpid::StepResult<S...>> {
  using type = std::remove_reference_t<decltype(std::declval<const limpid::StepResult<S...>&>().template get<I>())>;
};
