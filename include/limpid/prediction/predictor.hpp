// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/tool.hpp>

#include <concepts>

namespace limpid {

/// Where the tool is taken to be now.
template <int Axes = 1, Real Scalar = double>
struct Prediction {
  Motion<Axes, Scalar> motion;  ///< always finite
  Status status = Status::ok;
};

/// What adapts a type to the Predictor concept. The primary template forwards to members of the same names; to adapt a
/// foreign type, specialise it with all of
///
///     Scalar, axes               the real and the number of axes
///     observe(p, sample)         takes in a sample of the tool that has arrived; Status
///     advance(p, now, F_h)       the tool's motion at `now`, where the operator's force is F_h; Prediction
///
/// Laws. Within a tick `observe` comes before `advance`; a prediction depends on nothing later than its tick. A sample
/// not newer than the newest one is dropped with out_of_order. A sample stamped in the future leaves no trace: one that
/// was taken after it arrived is refused with clock_backwards, one taken after `now` is dropped by `advance` with
/// out_of_history, and later samples are not measured against its stamp. With time that does not advance, or with an
/// input that is not finite, the state stays and the last motion is returned with clock_backwards or not_finite. Every
/// motion is finite. However absurd a finite sample is, one good sample later no answer has not_finite any more. Before
/// the first sample the status has no_sample. Both are `noexcept` and allocate nothing.
template <typename P>
struct PredictorTraits {};

/// Members from which the primary template reads all it needs.
template <typename P>
concept HasPredictorMembers = requires(P& p, const ToolSample<P::axes, typename P::Scalar>& sample,
                                       const Eigen::Array<typename P::Scalar, P::axes, 1>& F_h) {
  p.observe(sample);
  p.advance(Time{}, F_h);
};

template <HasPredictorMembers P>
struct PredictorTraits<P> {
  using Scalar = typename P::Scalar;
  static constexpr int axes = P::axes;

  [[nodiscard]] static Status observe(P& p, const ToolSample<axes, Scalar>& sample) noexcept {
    return p.observe(sample);
  }

  [[nodiscard]] static Prediction<axes, Scalar> advance(P& p, Time now,
                                                        const Eigen::Array<Scalar, axes, 1>& F_h) noexcept {
    return p.advance(now, F_h);
  }
};

/// Brings late samples of the tool to the present. See PredictorTraits.
template <typename P>
concept Predictor =
    Real<typename PredictorTraits<P>::Scalar> &&(PredictorTraits<P>::axes > 0) &&
    requires(P& p, const ToolSample<PredictorTraits<P>::axes, typename PredictorTraits<P>::Scalar>& sample,
             const Eigen::Array<typename PredictorTraits<P>::Scalar, PredictorTraits<P>::axes, 1>& F_h) {
  { PredictorTraits<P>::observe(p, sample) } -> std::same_as<Status>;
  {
    PredictorTraits<P>::advance(p, Time{}, F_h)
    } -> std::convertible_to<Prediction<PredictorTraits<P>::axes, typename PredictorTraits<P>::Scalar>>;
};

/// Keeps the laws of a predictor on stamps: knows the sample observed since its last tick and the newest before that.
///
/// A sample is pending until a tick settles it. One that was taken after that tick is forgotten, so that its stamp does
/// not shut out those that come later.
/// @realtime  no allocation, no throw
class SampleStamps {
 public:
  /// Whether a sample taken then is not newer than the newest one.
  [[nodiscard]] bool seen(Time taken) const noexcept { return any_ && taken <= taken_; }
  [[nodiscard]] bool pending() const noexcept { return pending_; }
  [[nodiscard]] bool any() const noexcept { return any_; }
  [[nodiscard]] Time taken() const noexcept { return taken_; }

  void observe(Time taken) noexcept {
    taken_ = taken;
    any_ = pending_ = true;
  }

  /// Ends the wait of the pending sample.
  /// @return  out_of_history where it was taken after `now`, and is forgotten
  [[nodiscard]] Status settle(Time now) noexcept {
    pending_ = false;
    if (taken_ > now) {
      taken_ = settled_;
      any_ = settled_any_;
      return Status::out_of_history;
    }
    settled_ = taken_;
    settled_any_ = true;
    return Status::ok;
  }

 private:
  Time taken_{}, settled_{};
  bool any_ = false, settled_any_ = false, pending_ = false;
};

}  // namespace limpid
