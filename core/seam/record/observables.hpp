// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "seam/record/probes.hpp"
#include "seam/record/results.hpp"
#include "seam/scene/scene.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// The numbers that a scene asks for of each state: probes, integrals of fields, measures of interfaces,
/// formulas of these; and of the last one the errors against exact solutions.
class Observables {
 public:
  /// Collective. @throws Error with places in the scene, all that is wrong at once
  Observables(const Scene& scene, Problem& problem);

  /// All numbers of the present state: a row of the table that is recorded. Collective.
  /// @throws Error where one cannot be had or is no number
  [[nodiscard]] Results row(const TimePoint& at);
  /// Norms of errors of the present state, by name. Collective.
  [[nodiscard]] std::map<std::string, double> errors(double time);

 private:
  const Scene& scene_;
  Problem& problem_;
  std::vector<Probe> probes_;
  bool names_checked_ = false;
};

}  // namespace seam
