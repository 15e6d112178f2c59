// SPDX-License-Identifier: MIT
#include "transparency_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>

namespace limpid::examples {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

// The loop of SampledWall, ticked through.
class StepLoop {
 public:
  StepLoop(const SampledWall<>& loop, const HapticPlant<>& plant, const WallFeedback<>& feedback, double force)
      : loop_{loop}, plant_{plant}, feedback_{feedback}, F_h_{force} {
    const double angle = 2 * std::acos(-1.0) * loop.cutoff * loop.period;
    filter_ = detail::velocity_filter(loop.velocity, std::exp(-angle), angle, 1.0);
    forces_.assign(static_cast<std::size_t>(loop.periods()) + 2, 0.0);
    sample();
  }

  [[nodiscard]] double position() const { return state_.x; }
  [[nodiscard]] double force() const { return forces_.front(); }
  [[nodiscard]] double position_after(double h) const { return after(h).x; }

  void tick() {
    state_ = after(loop_.period);
    sample();
  }

 private:
  struct State {
    double x = 0, v = 0;
  };

  // F_d = K_c x + B_c v, (12)
  void sample() {
    const bool difference = loop_.velocity == VelocitySource::backward_difference;
    const double measured = difference ? state_.x / loop_.period : state_.v;
    velocity_ = filter_.pole * velocity_ + filter_.gain * measured + filter_.rest * last_measured_;
    last_measured_ = measured;
    forces_.push_front(feedback_.K_c * state_.x + feedback_.B_c * velocity_);
    forces_.pop_back();
  }

  // m v' = F_h - F_d - b v, exact under a held force
  [[nodiscard]] State moved(const State& from, double F_d, double h) const {
    const auto flow = detail::second_order_flow(0.0, plant_.damping / plant_.mass, h);
    const double f = (F_h_ - F_d) / plant_.mass;
    return {from.x + flow.g * from.v + flow.s * f, flow.phi22 * from.v + flow.g * f};
  }

  // h after the sample, at most a period
  [[nodiscard]] State after(double h) const {
    const auto periods = static_cast<std::size_t>(loop_.periods());
    const double fraction = loop_.fraction(), first = std::min(h, fraction);
    const State changed = fraction > 0 ? moved(state_, forces_[periods + 1], first) : state_;
    return moved(changed, forces_[periods], h - first);
  }

  SampledWall<> loop_;
  HapticPlant<> plant_;
  WallFeedback<> feedback_;
  double F_h_;
  detail::VelocityFilter<double> filter_{};
  State state_{};
  double velocity_ = 0, last_measured_ = 0;
  std::deque<double> forces_{};  // F_d, newest first
};

// Until what is left of the start is a ten thousandth, and the points are passed.
long ticks_of(const SampledWall<>& loop, double radius) {
  const double points = StepResponse::times.back() / loop.period + 1;
  const double decay = radius < 1 ? std::log(1e-4) / std::log(radius) : 0;
  return static_cast<long>(std::clamp(std::max({points, decay, 200.0}), 200.0, 200'000.0));
}

}  // namespace

StepResponse step_response(const SampledWall<>& loop, const HapticPlant<>& plant, const WallFeedback<>& feedback,
                           double force) {
  const double radius = sampled_wall_radius(loop, plant, feedback);
  const long ticks = ticks_of(loop, radius), stride = std::max(1L, ticks / 5000);
  StepResponse response{.gain = feedback.B_c, .end = force / feedback.K_c};
  response.points.fill(nothing);
  StepLoop step(loop, plant, feedback, force);
  double most = 0;
  long left = -1;  // the last sample outside the 2 %
  std::size_t next = 0;
  for (long k = 0; k <= ticks; ++k, step.tick()) {
    const double part = step.position() / response.end, now = static_cast<double>(k) * loop.period;
    if (!(std::abs(part) < 100)) break;  // it grows, and is not worth drawing
    for (; next < response.points.size() && StepResponse::times[next] < now + loop.period; ++next) {
      response.points[next] = step.position_after(std::max(0.0, StepResponse::times[next] - now));
    }
    most = std::max(most, part);
    if (std::abs(part - 1) > 0.02) left = k;
    if (k % stride != 0) continue;
    response.time.push_back(now);
    response.position.push_back(step.position());
    response.force.push_back(step.force());
  }
  const bool settles = radius < 1 && left < ticks;
  response.overshoot = settles ? std::max(0.0, most - 1) : nothing;
  response.settling = settles ? static_cast<double>(left + 1) * loop.period : nothing;
  return response;
}

}  // namespace limpid::examples
