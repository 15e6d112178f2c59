// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace limpid {

/// What a norm of a system is.
enum class NormVerdict {
  finite,     ///< the number is the norm
  unstable,   ///< infinite: a pole is not in the open left half plane or unit disc, to within rounding
  unbounded,  ///< infinite: stable, but what goes straight through (D, in continuous time) has infinite energy
  undecided,  ///< the entries are too large or too small to tell; infinite is said
};

[[nodiscard]] constexpr std::string_view describe(NormVerdict verdict) noexcept {
  switch (verdict) {
    case NormVerdict::finite:
      return "finite";
    case NormVerdict::unstable:
      return "infinite, the system is not stable";
    case NormVerdict::unbounded:
      return "infinite, the input goes straight through";
    default:
      return "not decided, numbers out of range";
  }
}

}  // namespace limpid
