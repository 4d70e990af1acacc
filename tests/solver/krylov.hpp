// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "seam/linear/krylov_solver.hpp"
#include "seam/plugin/registry.hpp"

namespace seam::test {

struct KrylovOptions {
  double tolerance = 1e-12;
  double keep = 1.5;
  long fill = 1;
};

/// @param preconditioner of all fields
inline KrylovSolver krylov(const std::string& preconditioner, const KrylovOptions& options = {}) {
  static const Registry registry = [] {
    Registry all;
    register_linear_solvers(all);
    return all;
  }();
  Parameters inverse, p;
  inverse.set_type(preconditioner);
  inverse.set("fill", {options.fill, {}, {}, true});
  p.set("tolerance", {options.tolerance, {}, {}, true});
  p.set("maximum_iterations", {300L, {}, {}, true});
  p.set("restart", {100L, {}, {}, true});
  p.set("keep", {options.keep, {}, {}, true});
  p.set("preconditioner", {std::vector<Parameters>{inverse}, {}, {}, true});
  p.set("fields", {std::vector<std::pair<std::string, Parameters>>{}, {}, {}, true});
  return {p, registry};
}

}  // namespace seam::test
