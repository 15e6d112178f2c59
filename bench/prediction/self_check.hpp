// SPDX-License-Identifier: MIT
#pragma once

namespace limpid::bench {

/// Holds the matrix's parts against answers that are known; prints each.
/// @return  whether all were met
[[nodiscard]] bool self_check();

}  // namespace limpid::bench
