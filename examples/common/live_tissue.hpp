// SPDX-License-Identifier: MIT
#pragma once

#include "palpation_run.hpp"

#include <limpid/control/fade.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/loop/realtime/environment_exchange.hpp>
#include <limpid/loop/realtime/environment_link.hpp>
#include <limpid/loop/realtime/slow_environment.hpp>
#include <limpid/signal/sample.hpp>

#include <cstdint>
#include <exception>
#include <memory>
#include <thread>
#include <utility>

namespace limpid::examples {

/// The scene's tissue on a thread of its own, truly slow and late; the loop's end of it. Times are those of the scene.
class LiveTissue {
 public:
  explicit LiveTissue(const Scene& scene)
      : environment_(exchange_, PlantTool{make_plant(scene)}, {.period = scene.period, .delay = scene.delay}),
        link_(exchange_, {.longest_age = LiveSettings::longest_age(scene.period, scene.delay)}),
        fade_({.fade_out = LiveSettings::fade_out, .fade_in = LiveSettings::fade_in, .hold = LiveSettings::hold}),
        remote_{scene.remote},
        thread_(environment_.start()) {}

  /// Hands on the operator's force, N, and takes what has arrived; once a tick, before the loop's blocks. That it is
  /// stale goes to the fade, and not to the limiter, to which it would be a fault.
  void exchange(Time now, double force) noexcept {
    (void)link_.send(now, EnvironmentExchange<1>::Vector(force));
    const auto& seen = link_.read(now);
    remote_->seen = {.value = seen.value, .taken = seen.taken, .arrived = seen.arrived, .fresh = seen.fresh};
    samples_ += seen.fresh ? 1 : 0;
    remote_->factor = fade_.update(now, !has(seen.status, Status::stale));
    faded_ += has(seen.status, Status::stale) ? 1 : 0;
  }

  [[nodiscard]] double factor() const noexcept { return remote_->factor; }  ///< of its force
  [[nodiscard]] std::uint64_t samples() const noexcept { return samples_; }
  [[nodiscard]] std::uint64_t faded() const noexcept { return faded_; }

 private:
  struct PlantTool {
    struct Output {
      ToolState<1> value;
      Status status;
    };
    Plant plant;

    Output advance(Time now, const EnvironmentExchange<1>::Vector& F_h) noexcept {
      try {
        return {along<1>(plant(now, F_h[0])), Status::ok};
      } catch (const std::exception&) {
        return {{}, Status::not_finite};  // it cannot follow: no sample, and the force fades
      }
    }
  };

  EnvironmentExchange<1> exchange_;
  SlowEnvironment<EnvironmentExchange<1>, PlantTool> environment_;
  EnvironmentLink<EnvironmentExchange<1>> link_;
  Fade<> fade_;
  std::shared_ptr<RemoteTissue> remote_;
  std::uint64_t samples_ = 0, faded_ = 0;
  std::jthread thread_;  // the last: it ends before what it uses
};

}  // namespace limpid::examples
