// SPDX-License-Identifier: MIT
#pragma once

#include "live_run.hpp"
#include "press_force.hpp"
#include "sensing.hpp"
#include "tool_in_tissue.hpp"

#include <limpid/core/time.hpp>
#include <limpid/environment/operator_hand.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/evaluation/error_norms.hpp>
#include <limpid/evaluation/latency_histogram.hpp>
#include <limpid/signal/sample.hpp>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace limpid::examples {

enum class TissueKind { kelvin_voigt, smooth_bilinear, hunt_crossley, exponential, layered };
enum class PredictorKind { hold, model, ideal, linear, quadratic, autoregressive, smith, replay, curve, chosen };
enum class RobotKind { ideal, realistic };

[[nodiscard]] const char* name(TissueKind kind);
[[nodiscard]] const char* name(PredictorKind kind);

/// What is pressed; only the fields of its kind are read.
struct Tissue {
  TissueKind kind = TissueKind::kelvin_voigt;
  double stiffness = 800;                            ///< k, or the first slope, N/m (N/m^exponent for hunt_crossley)
  double stiffness2 = 800;                           ///< the second slope of smooth_bilinear, N/m
  double depth = 0.0028;                             ///< x_s of smooth_bilinear, m
  double sharpness = 20;                             ///< R of smooth_bilinear
  double exponent = 1.3;                             ///< of hunt_crossley
  double amplitude = 0.5;                            ///< A of exponential, N
  double growth = 600;                               ///< r of exponential, 1/m
  std::array<double, 3> layers{400, 1500, 800};      ///< stiffnesses of layered, N/m
  std::array<double, 2> boundaries{0.0015, 0.0025};  ///< of the layers, m
  double damping = 30;                               ///< b, N s/m
  bool unilateral = false;                           ///< whether the tool may leave the wall
  std::optional<double> wall{};  ///< where the tissue begins, m, touched from one side; none: at the start
};

/// Whether its two-parameter model (k, b) is estimated; of any other tissue (k, c), with b known.
[[nodiscard]] inline bool estimates_damping(const Tissue& tissue) {
  return tissue.kind == TissueKind::kelvin_voigt && !tissue.wall;
}

/// What the tissue does beside that, and how it is sampled.
struct Disturbances {
  TissueChange tissue;
  double step_at = 0;  ///< when the stiffness steps, s
  Sensing sensing;     ///< of depth, velocity and force; the acceleration is sent as it is
  std::uint32_t seed = 1;
};

/// What the predictor starts from; the boxes, gains and forgetting factors are those of 6.1.3 and 6.2.2 unless said.
struct Estimation {
  double stiffness = 1100;  ///< start of k, N/m
  double damping = 30;      ///< start of b; where the tissue is nonlinear, b as the offset model knows it, N s/m
  bool known = false;       ///< the predictor knows the tissue, not what disturbs it: nothing is estimated
  bool linear = false;      ///< k and b are estimated of a nonlinear tissue too (7.1.2), and not k and c
  double least_damping = 20, least_offset = -55;  ///< lower ends of the boxes of b, N s/m, and c, N
  double damping_gain = 8e6;                      ///< Gamma_e(0) of b
  std::optional<double> forgetting{};             ///< alpha; nothing: 2 for k and b, 20 for k and c
};

/// L1, L2, or L0, L1, L2 of a scheduled gain, each a pair (position in N/m, velocity in N s/m).
using PredictorGain = std::vector<double>;

/// A hand that holds the tip along the press axis, and leaves it free across that; its intention is the scene's force.
struct HandModel {
  double mass = 0;       ///< M, kg
  double damping = 0;    ///< B of the grip, N s/m
  double stiffness = 0;  ///< K of the grip, N/m
};

/// A three-axis force sensor whose frames come 1 to 3 ms apart.
struct ForceSensorModel {
  double cross_talk = 0;  ///< what each axis shows of a force along each other one, as a part of it
  double noise = 0;       ///< standard deviation of each axis, N
};

/// What a loop sees of a tissue that runs elsewhere.
struct RemoteTissue {
  Held<ToolState<1>> seen{};
  double factor = 0;  ///< of what makes the tissue felt: less than 1 where it has given no sample for too long
};

class LiveDevice;

/// One palpation: a recorded hand presses a simulated Omni against a slow tissue.
struct Scene {
  Tissue tissue;
  Disturbances disturbances;
  Estimation estimation;
  PredictorGain gain{0, 0};
  Tool<1> tool{.mass = 0.1, .damping = 0.1};
  PressForce force;
  Duration duration{};
  Duration tick = std::chrono::milliseconds{1};
  Duration period{};  ///< of the tissue's samples
  Duration delay{};   ///< from taking a sample to seeing it
  RobotKind robot = RobotKind::ideal;
  std::optional<HandModel> hand;                   ///< none: the operator's force is the scene's, whatever the tip does
  std::optional<ForceSensorModel> force_sensor{};  ///< none: the operator's force is known as it is
  bool playback = false;  ///< the operator's force acts on the tissue alone, not on the arm (7.1)
  Eigen::Vector3d start{0, 0.78539816339744830962, -1.25};  ///< q(0), rad
  /// Section 6.1.4: the tool's spring pulls toward the origin of the base frame, so that y and z move too; they are
  /// sampled and held without prediction, and exact with it.
  bool spring_at_base = false;
  std::optional<LiveSettings> live;      ///< none: as fast as it can, on a simulated device and tissue
  std::shared_ptr<RemoteTissue> remote;  ///< of a live run, made by it
  std::shared_ptr<LiveDevice> device;    ///< likewise
};

/// Signals of one tick, for curves; N, m, s.
struct TracePoint {
  double time, intention, force;         ///< what the operator intends, and does: one, without a hand
  double ideal, predicted, tip;          ///< along the press axis, from the wall
  double prediction_error, total_error;  ///< 2-norms of (3.35)
  Eigen::Array2d parameters;             ///< k and b (or c) as estimated; zero where nothing is
  Eigen::Vector3d torque;                ///< N m, as applied
};

/// What one predictor made of a scene.
struct PalpationResult {
  ErrorNorms<3> prediction, total;
  LatencyHistogram tick;       ///< of the loop's own work, ns
  HandEnergy<> energy;         ///< of the scene's hand at the end, J
  Status status = Status::ok;  ///< joined over the run, without what the first samples' absence explains
  std::vector<TracePoint> trace;
  std::optional<LiveReport> live;
};

/// Called now and then with the fraction done.
using ProgressCallback = std::function<void(double)>;

/// Runs the scene with one predictor.
/// @throws std::invalid_argument  where the scene contradicts itself
[[nodiscard]] PalpationResult palpate(const Scene& scene, PredictorKind predictor,
                                      const ProgressCallback& progress = {});

}  // namespace limpid::examples
