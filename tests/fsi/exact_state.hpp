// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fsi_vortices.hpp"
#include "materials.hpp"
#include "seam/physics/potential.hpp"
#include "seam/scene/function.hpp"
#include "seam/scene/validate.hpp"

namespace seam::test {

/// The manufactured solution with these parameters.
std::unique_ptr<Function> vortices(const std::string& yaml);

/// The components of a part of a function.
std::vector<Expression> part(const std::shared_ptr<const Function>& function, const std::string& name);
/// Their values.
std::vector<double> values(const Function& function, const std::string& name, const double* x, double t);

/// A material of the solid plugin.
std::shared_ptr<const Potential> material(const std::string& type, double young, double poisson);

}  // namespace seam::test
