// SPDX-License-Identifier: MIT
// The tissue and the tool in it, as they truly are.
#include "palpation_run.hpp"
#include "palpation_tissue.hpp"

#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/virtual_tool.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace limpid::examples {

namespace {

[[noreturn]] void refuse_motion(const std::string& why) {
  throw std::runtime_error("--tool, --stiffness, --damping, --force: the tool's motion is too fast to be integrated (" +
                           why + ")");
}

ToolState<3> in_space(const ToolState<3>& tool) { return tool; }

ToolState<3> in_space(const ToolState<1>& tool) {
  return {{tool.x[0], 0, 0}, {tool.v[0], 0, 0}, {tool.a[0], 0, 0}, {tool.force[0], 0, 0}};
}

template <Environment E>
Plant undisturbed(const Scene& scene, const E& environment, const EnvironmentTheta<E>& theta) {
  constexpr int axes = EnvironmentTraits<E>::axes;
  using Simulated = VirtualTool<E>;
  const auto tool = std::make_shared<Simulated>(
      typename Simulated::Settings{.environment = environment, .theta = theta, .tool = tool_of<axes>(scene)});
  return [tool](Time now, double force) {
    typename Simulated::Vector F_h = Simulated::Vector::Zero();
    F_h[0] = force;
    const auto [state, status] = tool->advance(now, F_h);
    if (status != Status::ok) refuse_motion(describe(status));
    return in_space(state);
  };
}

class DisturbedTool {
 public:
  explicit DisturbedTool(const Scene& scene)
      : force_{undisturbed_force(scene.tissue), scene.disturbances.tissue, scene.disturbances.step_at},
        tool_{scene.tool},
        moved_{force_, tool_} {}

  ToolState<3> advance(Time now, double F_h) {
    if (started_) {
      const double begin = in_seconds(now_), length = in_seconds(now - now_);
      moved_.advance(s_, begin, length, F_h_, F_h, steps(length));
    }
    started_ = true;
    now_ = now;
    F_h_ = F_h;
    const double F_e = moved_.force(s_, in_seconds(now), F_h);
    const double a = (F_h - F_e - tool_.damping * s_.v - tool_.stiffness * s_.x) / tool_.mass;
    if (!std::isfinite(a)) refuse_motion(describe(Status::not_finite));
    return {{s_.x, 0, 0}, {s_.v, 0, 0}, {a, 0, 0}, {F_e, 0, 0}};
  }

 private:
  // Of 50 us, or a fiftieth of what decays fastest: a step of fourth order then errs by 3e-11 of what it decays by.
  [[nodiscard]] int steps(double length) const {
    constexpr double longest = 5e-5, most = 2000;
    const double count = std::ceil(std::max(length / longest, 50 * length * force_.fastest(s_.x, tool_)) - 1e-9);
    if (!(count <= most)) refuse_motion(describe(Status::limited));
    return static_cast<int>(count);
  }

  TissueForce force_;
  Tool<1> tool_;
  ToolInTissue moved_;
  ToolInTissue::State s_;
  double F_h_ = 0;  // at the last tick
  Time now_{};
  bool started_ = false;
};

}  // namespace

Plant make_plant(const Scene& scene) {
  const Tissue& tissue = scene.tissue;
  const bool disturbed = scene.disturbances.tissue.any();
  if (scene.spring_at_base) {
    if (!is_linear(tissue) || disturbed || scene.disturbances.sensing.any()) {
      throw std::invalid_argument(
          "Scene: spring_at_base: expected a bilateral kelvin_voigt tissue without disturbances");
    }
    EnvironmentTheta<KelvinVoigt<3>> theta = EnvironmentTheta<KelvinVoigt<3>>::Zero();
    theta.row(0) << tissue.stiffness, tissue.damping;
    return undisturbed(scene, KelvinVoigt<3>{}, theta);
  }
  if (disturbed) {
    return [tool = std::make_shared<DisturbedTool>(scene)](Time now, double F_h) { return tool->advance(now, F_h); };
  }
  if (is_linear(tissue)) return undisturbed(scene, KelvinVoigt<1>{}, {tissue.stiffness, tissue.damping});
  return undisturbed(scene, model_of(tissue), TissueModel::Theta::Ones());
}

}  // namespace limpid::examples
