// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/device/force_sensor.hpp>
#include <limpid/signal/delayed_sampled.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>

namespace limpid {

/// A force sensor with the faults of a real one: what it feels of a true force comes in frames at irregular intervals,
/// some of which are lost, with noise and cross-talk, clipped to its range, and late.
/// @realtime  advance, read: no allocation, no throw for built-in scalars; advance makes at most 64 longest intervals
///            of frames at once, of a longer leap only the last ones
template <Real Scalar_ = double>
class SimulatedForceSensor {
 public:
  using Scalar = Scalar_;
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;

  struct Settings {
    Matrix response = Matrix::Identity();  ///< what axis i (row) shows of a force along j, N/N: cross-talk beside 1
    Vector noise = Vector::Zero();         ///< standard deviation of each axis, >= 0, N
    Vector range = Vector::Constant(std::numeric_limits<Scalar>::infinity());  ///< of each axis, either way, > 0, N
    Duration shortest = std::chrono::milliseconds(1);  ///< between frames, which are evenly spread from it, > 0,
    Duration longest = std::chrono::milliseconds(3);   ///< to this; Fig. 5.13
    Duration delay{};                                  ///< from feeling to seeing, >= 0, below 64 shortest intervals
    double loss = 0;                                   ///< part of the frames that do not arrive, [0, 1]
    Duration longest_age = std::chrono::milliseconds(20);  ///< beyond which the newest is stale; > delay
    std::uint64_t seed = 1;
  };

  /// @throws std::invalid_argument  where the settings cannot serve
  explicit SimulatedForceSensor(const Settings& settings = Settings{})
      : settings_{checked(settings)},
        on_their_way_{{.period = settings.shortest,
                       .delay = settings.delay,
                       .longest_age = settings.delay + settings.longest_age + settings.shortest}},
        random_{settings.seed} {}

  /// Lets time pass up to `now`; between two calls the true force is a straight line. The first frame is felt in the
  /// first call.
  /// @param force  true one at `now`, N, in the sensor's frame
  /// @return       `ok`; or, with nothing changed, `not_finite` or `clock_backwards`
  [[nodiscard]] Status advance(Time now, const Vector& force) noexcept {
    if (!is_finite(force)) return Status::not_finite;
    if (started_ && now <= now_) return Status::clock_backwards;
    if (!started_) {
      now_ = due_ = now;
      force_ = force;
    }
    if (elapsed(now, due_) > 64 * settings_.longest) due_ = now - 64 * settings_.longest;
    while (due_ <= now && due_ < Time::max()) {
      feel(due_, now == now_ ? force : Vector(force_ + (force - force_) * part_of_way<Scalar>(due_, now_, now)));
      due_ = later(due_, interval());
    }
    (void)see(now);
    started_ = true;
    now_ = now;
    force_ = force;
    return Status::ok;
  }

  /// What was seen at the last `advance`.
  [[nodiscard]] ForceReading<Scalar> read(Time now) noexcept {
    ForceReading<Scalar> reading{seen_.force, stamp_, when(!any_, Status::no_sample)};
    reading.status |= when(!connected_, Status::disconnected) | when(seen_.clipped, Status::overload) |
                      when(any_ && elapsed(now, stamp_) > settings_.longest_age, Status::stale);
    return reading;
  }

  /// Pulls the plug: frames on their way are lost.
  void disconnect() noexcept { connected_ = false; }
  void reconnect() noexcept {
    if (connected_) return;
    connected_ = true;
    unplugged_until_ = now_;
  }

 private:
  struct Felt {
    Vector force = Vector::Zero();  // N
    bool clipped = false;
    friend bool is_finite(const Felt& felt) noexcept { return limpid::is_finite(felt.force); }
  };

  static const Settings& checked(const Settings& settings) {
    expect(is_finite(settings.response), "SimulatedForceSensor: response", "finite", settings.response);
    expect(is_finite(settings.noise) && (settings.noise.array() >= Scalar(0)).all(), "SimulatedForceSensor: noise",
           "finite and >= 0", settings.noise);
    expect((settings.range.array() > Scalar(0)).all(), "SimulatedForceSensor: range", "> 0", settings.range);
    expect(settings.shortest > Duration::zero(), "SimulatedForceSensor: shortest", "> 0", settings.shortest);
    expect(settings.longest >= settings.shortest && settings.longest < std::chrono::hours(1),
           "SimulatedForceSensor: longest", ">= shortest and below an hour", settings.longest);
    expect(settings.delay >= Duration::zero() && settings.delay / settings.shortest < 64, "SimulatedForceSensor: delay",
           ">= 0 and below 64 shortest intervals", settings.delay);
    expect(settings.loss >= 0 && settings.loss <= 1, "SimulatedForceSensor: loss", "in [0, 1]", settings.loss);
    expect(settings.longest_age > settings.delay && settings.longest_age < std::chrono::hours(24),
           "SimulatedForceSensor: longest_age", "> delay and below a day", settings.longest_age);
    return settings;
  }

  [[nodiscard]] Duration interval() noexcept {
    using Spread = std::uniform_int_distribution<Duration::rep>;
    return Duration{Spread(settings_.shortest.count(), settings_.longest.count())(random_)};
  }

  void feel(Time at, const Vector& force) noexcept {
    Vector shown = settings_.response * force;
    for (Eigen::Index axis = 0; axis < 3; ++axis) shown[axis] += settings_.noise[axis] * Scalar(normal_(random_));
    const Vector inside = shown.cwiseMin(settings_.range).cwiseMax(-settings_.range);
    const bool lost = std::bernoulli_distribution(settings_.loss)(random_);
    if (!lost && connected_) (void)on_their_way_.offer({{inside, inside != shown}, at, later(at, settings_.delay)});
    see(at);
  }

  // What has arrived by `now`.
  void see(Time now) noexcept {
    const auto& held = on_their_way_.update(now);
    if (!connected_ || has(held.status, Status::no_sample | Status::clock_backwards)) return;
    if (held.taken <= unplugged_until_) return;  // was on its way when the plug was pulled
    seen_ = held.value;
    stamp_ = held.taken;
    any_ = true;
  }

  Settings settings_;
  DelayedSampled<Felt> on_their_way_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_{};
  Vector force_ = Vector::Zero();  // true one at now_, N
  Time now_{}, due_{};
  Time unplugged_until_ = Time::min();
  bool started_ = false, connected_ = true, any_ = false;
  Felt seen_{};
  Time stamp_{};  // of seen_
};

}  // namespace limpid
