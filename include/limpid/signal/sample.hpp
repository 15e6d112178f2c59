// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>

namespace limpid {

/// A value that is zero; also of Eigen's types, which `T{}` would leave unset.
template <typename T>
[[nodiscard]] constexpr T zero() {
  if constexpr (requires { T::Zero(); }) {
    return T::Zero();
  } else {
    return T{};
  }
}

/// A value with the instant it was taken at and the instant it arrived.
template <typename T>
struct Sample {
  T value = zero<T>();
  Time taken{};    ///< instant the value belongs to
  Time arrived{};  ///< instant it is there for others to see; not before `taken`
};

/// The newest sample that has arrived, as a tick sees it: x_zd(t), thesis section 4.3.2.
template <typename T>
struct Held {
  T value = zero<T>();
  Time taken{};
  Time arrived{};
  bool fresh = false;          ///< whether this tick is the first to see it
  Status status = Status::ok;  ///< what the tick has to say about it
};

}  // namespace limpid
