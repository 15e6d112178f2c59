// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/status.hpp>

#include <boost/hana/tuple.hpp>
#include <boost/hana/type.hpp>

#include <string_view>

namespace limpid {

/// A signal is a tag: `struct JointTorque { using value_type = Eigen::Vector3d; };`
///
/// Optional members:
///   - `static constexpr const char* name`   for the diagram; the type's own name otherwise
///   - `static value_type initial()`         the value before the first tick; asked for only where a block reads the
///                                           signal as `Previous`, or its writer may be skipped
template <typename T>
concept Signal = requires {
  typename T::value_type;
};

/// What a block reads or writes: `using reads = limpid::signals<ToolSample, OperatorForce>;`, a Hana tuple of types.
template <Signal... S>
using signals = boost::hana::tuple<boost::hana::type<S>...>;

/// What the scene wants from a loop; blocks that do not serve it are dropped.
template <Signal... S>
struct wants {};

/// What the scene hands to a loop on each tick, in this order.
template <Signal... S>
struct inputs {};

/// In a block's `reads`: the value at the end of the last tick. It is what makes a cycle of blocks legal.
template <Signal S>
struct Previous {
  using value_type = typename S::value_type;
};

/// In a block's `reads`: the statuses of the inputs and of the blocks called so far in this tick, joined. Its reader is
/// called after every block that does not itself depend on a reader of it, so that safety hears of all that is
/// upstream.
struct TickStatus {
  using value_type = Status;
};

namespace wiring {

template <typename T>
constexpr std::string_view decorated_name() noexcept {
  return __PRETTY_FUNCTION__;
}

// "Predictor" of "scene::Predictor<limpid::Tool<3> >": between the last :: and the template arguments.
constexpr std::string_view plain(std::string_view name) noexcept {
  int depth = 0;
  std::size_t end = name.size();
  for (std::size_t i = name.size(); i-- > 0;) {
    if (name[i] == '>') ++depth;
    if (name[i] == '<' && --depth == 0) end = i;
    if (depth == 0 && name[i] == ':') return name.substr(i + 1, end - i - 1);
  }
  return name.substr(0, end);
}

}  // namespace wiring

/// The name of a signal or a block for people: its `name`, or that of its type without scopes and template arguments.
template <typename T>
[[nodiscard]] constexpr std::string_view name_of() noexcept {
  if constexpr (requires { std::string_view{T::name}; }) {
    return T::name;
  } else {
    constexpr std::string_view sample = wiring::decorated_name<int>();
    constexpr std::size_t before = sample.rfind("int"), after = sample.size() - before - 3;
    const std::string_view name = wiring::decorated_name<T>();
    return wiring::plain(name.substr(before, name.size() - before - after));
  }
}

}  // namespace limpid
