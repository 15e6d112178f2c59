// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/loop/signal.hpp>

#include <concepts>
#include <type_traits>
#include <utility>

namespace limpid {

/// A block adapts a component to a loop: it names the signals it `reads` and `writes` and is called once a tick with
/// the time and the value of each signal it reads, in that order:
/// ```cpp
/// struct Tracking {
///   using reads = limpid::signals<DesiredMotion, JointState>;
///   using writes = limpid::signals<JointTorque>;
///   Output operator()(Time now, const DesiredMotion::value_type&, const JointState::value_type&);
///   bool active(Time now, const DesiredMotion::value_type&, const JointState::value_type&) const;  // optional
/// };
/// ```
/// It returns the value it writes, or any struct {value, status}, as components do; a block that writes several signals
/// returns a `std::tuple` of such. A member `status` is joined with those of the other blocks.
/// Where `active` says false the block is not called in this tick: its signals keep their last value, its status is ok.
template <typename B>
concept Block = requires {
  typename B::reads;
  typename B::writes;
};

/// A value with a status, for a block to return.
template <typename T>
struct Reported {
  T value;
  Status status = Status::ok;
};

template <typename T>
Reported(T, Status) -> Reported<T>;

/// A function as a block; made by `make_block`.
template <typename Tag, typename Reads, typename Writes, typename Function>
struct FunctionBlock {
  using tag = Tag;
  using reads = Reads;
  using writes = Writes;

  template <typename... Values>
  [[gnu::always_inline]] constexpr decltype(auto) operator()(Time now, const Values&... values) noexcept(
      std::is_nothrow_invocable_v<Function&, Time, const Values&...>) requires
      std::invocable<Function&, Time, const Values&...> {
    return function(now, values...);
  }

  [[no_unique_address]] Function function;
};

/// A function as a block that may be skipped; made by `make_block`.
template <typename Tag, typename Reads, typename Writes, typename Function, typename Active>
struct SkippableBlock : FunctionBlock<Tag, Reads, Writes, Function> {
  template <typename... Values>
  [[gnu::always_inline]] constexpr bool active(
      Time now, const Values&... values) const requires std::predicate<const Active&, Time, const Values&...> {
    return is_active(now, values...);
  }

  [[no_unique_address]] Active is_active;
};

/// Names a function as a block, by a tag that need not be defined:
/// `make_block<struct Prediction, signals<OperatorForce>, signals<Motion>>([p](Time now, const Force& f) mutable
/// {...})`
template <typename Tag, typename Reads, typename Writes, typename Function>
[[nodiscard]] constexpr auto make_block(Function&& function) {
  return FunctionBlock<Tag, Reads, Writes, std::decay_t<Function>>{std::forward<Function>(function)};
}

/// The same, called only on ticks on which `active`, given the same arguments, returns true.
template <typename Tag, typename Reads, typename Writes, typename Function, typename Active>
[[nodiscard]] constexpr auto make_block(Function&& function, Active&& active) {
  return SkippableBlock<Tag, Reads, Writes, std::decay_t<Function>, std::decay_t<Active>>{
      {std::forward<Function>(function)}, std::forward<Active>(active)};
}

namespace wiring {

// What a block is called by: its own type, or the tag it was made with.
template <typename B>
struct Tagged {
  using tag = B;
};
template <typename B>
requires requires { typename B::tag; }
struct Tagged<B> {
  using tag = typename B::tag;
};
template <typename B>
using tag_of = typename Tagged<B>::tag;

// A value returned by a block is the signal's value itself or has it as its member `value`.
template <typename V, typename R>
concept Carries = std::same_as<std::remove_cvref_t<R>, V> || requires(const std::remove_cvref_t<R>& r) {
  requires std::same_as<std::remove_cvref_t<decltype(r.value)>, V>;
};

template <typename V, typename R>
[[gnu::always_inline]] constexpr const V& carried(const R& returned) noexcept {
  if constexpr (std::same_as<R, V>) {
    return returned;
  } else {
    return returned.value;
  }
}

template <typename R>
[[gnu::always_inline]] constexpr Status status_of(const R& returned) noexcept {
  if constexpr (requires {
                  { returned.status } -> std::convertible_to<Status>;
                }) {
    return returned.status;
  } else {
    return Status::ok;
  }
}

}  // namespace wiring

}  // namespace limpid
