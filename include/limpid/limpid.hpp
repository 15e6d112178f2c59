// SPDX-License-Identifier: MIT
#pragma once

// Everything that needs no system library.

#include <limpid/core/dormand_prince.hpp>
#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/second_order_step.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>

#include <limpid/signal/delayed_sampled.hpp>
#include <limpid/signal/filtered_derivative.hpp>
#include <limpid/signal/history.hpp>
#include <limpid/signal/intersample.hpp>
#include <limpid/signal/low_pass.hpp>
#include <limpid/signal/quantiser.hpp>
#include <limpid/signal/sample.hpp>

#include <limpid/environment/coupled.hpp>
#include <limpid/environment/environment.hpp>
#include <limpid/environment/fixed.hpp>
#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/tangent_model.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/environment/unilateral.hpp>
#include <limpid/environment/virtual_tool.hpp>

#include <limpid/estimation/any_above.hpp>
#include <limpid/estimation/box_projection.hpp>
#include <limpid/estimation/environment_estimate.hpp>
#include <limpid/estimation/environment_estimator.hpp>
#include <limpid/estimation/excitation.hpp>
#include <limpid/estimation/exponential_mean.hpp>
#include <limpid/estimation/least_squares_flow.hpp>
#include <limpid/estimation/projection_rls.hpp>
#include <limpid/estimation/symmetric_eigenvalues.hpp>
#include <limpid/estimation/ud_factors.hpp>

#include <limpid/prediction/gain_table.hpp>
#include <limpid/prediction/gains.hpp>
#include <limpid/prediction/held_tangents.hpp>
#include <limpid/prediction/hold_predictor.hpp>
#include <limpid/prediction/knots.hpp>
#include <limpid/prediction/model_predictor.hpp>
#include <limpid/prediction/predictor.hpp>

#include <limpid/design/adaptation_rate.hpp>
#include <limpid/design/ball.hpp>
#include <limpid/design/block_group.hpp>
#include <limpid/design/block_matrix.hpp>
#include <limpid/design/cell_proof.hpp>
#include <limpid/design/coefficient_product.hpp>
#include <limpid/design/common_quadratic.hpp>
#include <limpid/design/convex_polygon.hpp>
#include <limpid/design/delay_characteristic.hpp>
#include <limpid/design/delay_collocation.hpp>
#include <limpid/design/delay_stability.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/dynamic_block.hpp>
#include <limpid/design/dynamic_group.hpp>
#include <limpid/design/fixed_gain_lmi.hpp>
#include <limpid/design/gain_choice.hpp>
#include <limpid/design/gain_dual.hpp>
#include <limpid/design/gain_lmi.hpp>
#include <limpid/design/gain_spline.hpp>
#include <limpid/design/gain_vertices.hpp>
#include <limpid/design/grid.hpp>
#include <limpid/design/interior_point.hpp>
#include <limpid/design/lanczos_reach.hpp>
#include <limpid/design/largest_box.hpp>
#include <limpid/design/largest_certified_box.hpp>
#include <limpid/design/largest_root.hpp>
#include <limpid/design/lmi.hpp>
#include <limpid/design/lmi_block.hpp>
#include <limpid/design/lmi_certificate.hpp>
#include <limpid/design/lmi_dual_certificate.hpp>
#include <limpid/design/lmi_expression.hpp>
#include <limpid/design/lmi_problem.hpp>
#include <limpid/design/lmi_result.hpp>
#include <limpid/design/lmi_scaling.hpp>
#include <limpid/design/lmi_solver.hpp>
#include <limpid/design/map.hpp>
#include <limpid/design/margin_problem.hpp>
#include <limpid/design/mean_value_form.hpp>
#include <limpid/design/pack.hpp>
#include <limpid/design/predictor_bounds.hpp>
#include <limpid/design/predictor_margin.hpp>
#include <limpid/design/primal_dual_method.hpp>
#include <limpid/design/printed_theorem5.hpp>
#include <limpid/design/printed_theorems.hpp>
#include <limpid/design/reduced_lmi.hpp>
#include <limpid/design/reduced_theorem.hpp>
#include <limpid/design/root_radius.hpp>
#include <limpid/design/sampled_gain.hpp>
#include <limpid/design/sampled_polynomial.hpp>
#include <limpid/design/sampled_proof.hpp>
#include <limpid/design/sampled_stability.hpp>
#include <limpid/design/sampled_varying.hpp>
#include <limpid/design/sampled_worst.hpp>
#include <limpid/design/scaled_lmi.hpp>
#include <limpid/design/scaled_point.hpp>
#include <limpid/design/schur_system.hpp>
#include <limpid/design/sdp_problem.hpp>
#include <limpid/design/second_order_enclosure.hpp>
#include <limpid/design/second_order_flow.hpp>
#include <limpid/design/slow_mode.hpp>
#include <limpid/design/small_matrix.hpp>
#include <limpid/design/spline_design.hpp>
#include <limpid/design/theorem3.hpp>
#include <limpid/design/theorem3_design.hpp>
#include <limpid/design/theorem5.hpp>
#include <limpid/design/verified_cholesky.hpp>

#include <limpid/robot/inverse_kinematics.hpp>
#include <limpid/robot/joint_state.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_device.hpp>
#include <limpid/robot/omni_kinematics.hpp>
#include <limpid/robot/omni_pose.hpp>
#include <limpid/robot/robot.hpp>

#include <limpid/control/computed_torque.hpp>
#include <limpid/control/fault_reason.hpp>
#include <limpid/control/omni_safety.hpp>
#include <limpid/control/safe_torque.hpp>
#include <limpid/control/safety_limiter.hpp>
#include <limpid/control/safety_traits.hpp>
#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/control/torque_set.hpp>
#include <limpid/control/tracking_law.hpp>

#include <limpid/device/haptic_device.hpp>
#include <limpid/device/recording.hpp>
#include <limpid/device/simulated_omni.hpp>

#include <limpid/loop/block.hpp>
#include <limpid/loop/call.hpp>
#include <limpid/loop/check.hpp>
#include <limpid/loop/diagram.hpp>
#include <limpid/loop/graph.hpp>
#include <limpid/loop/loop.hpp>
#include <limpid/loop/result.hpp>
#include <limpid/loop/signal.hpp>
#include <limpid/loop/tick.hpp>
#include <limpid/loop/wiring.hpp>
#include <limpid/loop/wiring_errors.hpp>

#include <limpid/evaluation/error_norms.hpp>
#include <limpid/evaluation/latency_histogram.hpp>

#include <limpid/scene/palpation_blocks.hpp>
#include <limpid/scene/palpation_signals.hpp>
