// SPDX-License-Identifier: MIT
// The five-bar of `decouple`: linear at its pose, and simulated, each with an observer on each axis or without.
#pragma once

#include <limpid/control/q_filter.hpp>
#include <limpid/core/status.hpp>
#include <limpid/design/observer_stability.hpp>
#include <limpid/device/simulated_arm.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace limpid::examples {

enum class QKind { first_order, butterworth, umeno_hori };

inline constexpr std::array q_kinds{QKind::first_order, QKind::butterworth, QKind::umeno_hori};

[[nodiscard]] std::string_view name(QKind kind);  ///< as on the command line
/// @throws std::invalid_argument  where it is no such name
[[nodiscard]] QKind q_kind(const std::string& name);

inline constexpr double nominal_mass = 0.01, nominal_damping = 0.022;  ///< kg, N s/m; of both axes

/// M and B of (2) with the tip at (0.08, 0.22) m, at 1 kHz, and the nominal axes.
[[nodiscard]] ObservedPlant<2> linear_five_bar();

/// |vy/vx| of the linear device for a force along x that is held from tick to tick, of which an observer knows.
/// @param hertz  of the force
[[nodiscard]] double coupling_without_observer(const ObservedPlant<2>& plant, double hertz);

/// The same with a Tustin observer on each axis; nothing where it is unstable.
[[nodiscard]] std::optional<double> coupling(const ObservedPlant<2>& plant, QKind kind, double cutoff, double hertz);

/// The lowest cut-off at which the observers make the device unstable, Hz.
[[nodiscard]] CutoffLimit<> cutoff_limit(const ObservedPlant<2>& plant, QKind kind);

struct Observer {
  QKind kind = QKind::first_order;
  double cutoff = 50;  ///< Hz
};

/// A run of the simulated device under the operator's -A cos(2 pi f t) along x.
struct DecoupleRun {
  Realism realism = Realism::ideal;
  std::optional<Observer> observer{};
  double frequency = 5, force = 0.03;  ///< Hz, N
};

struct DecoupleTrace {
  std::vector<double> t, x, y;  ///< s, m; of the true tip, from where it starts
  double ratio = 0;             ///< |vy/vx| at the force's frequency, over the last second
  double y_range = 0;           ///< from the least to the greatest y of that second, m
  Status status = Status::ok;   ///< of all ticks, joined
  bool ended = false;           ///< false where the device left its limits or could not follow
};

[[nodiscard]] DecoupleTrace run(const DecoupleRun& what);

}  // namespace limpid::examples
