// SPDX-License-Identifier: MIT
#pragma once

#include "palpation_run.hpp"

namespace limpid::examples {

/// Makes the device of a live run, waits until it can be used, and begins the scene where its arm is.
/// @throws std::runtime_error  where there is no device that can be used, or the wait was interrupted
void prepare_live(Scene& scene);

/// The same ticks as of `run`, by the machine's clock: the device live, and the tissue on a thread of its own. Ends
/// early, with what was seen until then, by SIGINT or SIGTERM or where the device's fault ends it.
[[nodiscard]] PalpationResult run_live(const Scene& scene, const LoopStep& step, const ProgressCallback& progress);

}  // namespace limpid::examples
