// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "seam/scene/scene.hpp"

namespace seam {

/// Chooses the time steps of a run: fixed ones, ones that an estimate of the time error asks for, or those of
/// an earlier run. Steps end exactly at the kinks of loads; failed ones are halved.
class Stepper {
 public:
  /// @throws Error when the end does not come after the start, or recorded steps cannot be read
  explicit Stepper(const Scene& scene);

  [[nodiscard]] bool is_static() const { return static_; }
  /// Whether anything in the scene does.
  [[nodiscard]] bool depends_on_time() const { return depends_on_time_; }
  [[nodiscard]] bool adaptive() const { return adaptive_; }
  [[nodiscard]] double theta() const { return theta_; }
  /// True for BDF2; then theta is 1.
  [[nodiscard]] bool two_steps() const { return two_steps_; }
  [[nodiscard]] double start() const { return start_; }
  [[nodiscard]] double end() const { return end_; }
  /// True when nothing is left to do at this time.
  [[nodiscard]] bool finished(double time) const { return time >= end_ - 1e-10 * (end_ - start_); }

  /// Length of the step to try first, s.
  [[nodiscard]] double initial() const { return first_ > 0 ? first_ : initial_; }
  /// Where a step that should be `planned` long ends: earlier where a kink or the end comes first, and there
  /// exactly.
  /// @throws Error when that is not after `time`, since the step is too small beside it
  [[nodiscard]] double target(double time, double planned) const;
  /// The length to plan after a step that succeeded.
  /// @param planned, taken lengths it was to have and had
  /// @param error relative error of the step, 0 where it is not estimated
  [[nodiscard]] double after_success(double time, double planned, double taken, double error,
                                     int iterations) const;
  /// The length to try after a step of length `taken` failed; none when there is no use in trying.
  [[nodiscard]] std::optional<double> after_failure(double taken) const;
  /// True when the error of an adaptive step is so large that it must be repeated with a shorter one.
  [[nodiscard]] bool too_inaccurate(double error, double taken) const;

 private:
  void read_steps(const Parameters& step);
  [[nodiscard]] double aim(double time, double planned) const;
  [[nodiscard]] double to_grid(double time) const;
  bool static_ = true, adaptive_ = false, depends_on_time_ = false, two_steps_ = false;
  double theta_ = 1, start_ = 0, end_ = 1;
  double initial_ = 1, minimum_ = 1e-6, maximum_ = 1, tolerance_ = 1e-3;
  std::vector<double> kinks_{1.0};  ///< ascending, the end included
  double first_ = 0;                ///< length of the first step of a replay, s; 0 without one
  std::vector<double> replay_;      ///< ends of steps; empty when they are chosen here
};

}  // namespace seam
