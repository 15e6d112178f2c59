// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/latest_value.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/recent_values.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/tool.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

namespace limpid {

/// What passes between a fast loop and an environment that runs elsewhere, on a thread or in a process of its own: to
/// the environment the operator's forces with their instants, the newest of them and those before it; back the newest
/// state of the tool, with the instant it belongs to. Neither side waits for the other.
///
/// The loop has an EnvironmentLink to it, the environment an EnvironmentEnd; one of each at a time. In memory that
/// processes share it is a SharedObject.
/// @tparam Forces  how many forces are kept for the environment, a power of two: those of a second at 1 kHz
template <int Axes = 1, Real Scalar_ = double, std::size_t Forces = 1024>
requires std::is_trivially_copyable_v<Scalar_>
struct EnvironmentExchange {
  using Scalar = Scalar_;
  static constexpr int axes = Axes;
  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using State = ToolState<Axes, Scalar>;

  // Laid out alike whatever vectors the two sides are compiled for.
  using Entries = std::array<Scalar, static_cast<std::size_t>(Axes)>;
  struct Force {
    Time at{};
    Entries F_h{};  // N
  };
  struct Taken {
    Time at{};
    Entries x{}, v{}, a{}, F_e{};  // m, m/s, m/s^2, N
  };

  RecentValues<Force, Forces> forces{};  ///< loop to environment
  LatestValue<Taken> sample{};           ///< environment to loop

  static Entries entries(const Vector& vector) noexcept {
    Entries entries;
    std::copy_n(vector.data(), Axes, entries.data());
    return entries;
  }
  static Vector vector(const Entries& entries) noexcept { return Eigen::Map<const Vector>(entries.data()); }

  /// What both sides must agree on, in words.
  static std::string layout() {
    return "environment exchange 1: " + std::to_string(Axes) + " axes, scalars of " +
           std::to_string(std::numeric_limits<Scalar>::digits) + " bits, " + std::to_string(Forces) + " forces";
  }
};

/// The environment's end of an exchange: by its own clock, as seldom as it likes.
/// @realtime  no allocation, no throw; `forces` calls its function for each force since the last call
template <typename Exchange>
class EnvironmentEnd {
 public:
  using Vector = typename Exchange::Vector;
  using State = typename Exchange::State;

  /// Begins with the newest force that is there.
  explicit EnvironmentEnd(Exchange& exchange) noexcept
      : exchange_{&exchange}, next_{std::max<std::uint64_t>(exchange.forces.written(), 1) - 1} {}

  /// Calls `use(Time, Vector F_h)` for each force since the last call, in order.
  /// @return  `overflow`: some were lost, since there were more than the exchange keeps
  template <typename Use>
  Status forces(Use&& use) noexcept {
    bool lost = false;
    typename Exchange::Force force;
    for (const std::uint64_t end = exchange_->forces.written(); next_ < end;) {
      if (exchange_->forces.read(next_, force)) {
        use(force.at, Exchange::vector(force.F_h));
        ++next_;
      } else {
        lost = true;
        next_ = std::max(next_ + 1, exchange_->forces.oldest());
      }
    }
    return when(lost, Status::overflow);
  }

  /// Lets the loop see the tool's state at `taken`, an instant of one of its forces.
  void publish(Time taken, const State& state) noexcept {
    exchange_->sample.write({taken, Exchange::entries(state.x), Exchange::entries(state.v), Exchange::entries(state.a),
                             Exchange::entries(state.force)});
  }

 private:
  Exchange* exchange_;
  std::uint64_t next_;  // the force that comes next
};

}  // namespace limpid
