// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "seam/plugin/registry.hpp"
#include "seam/scene/scene.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// A unit with d, the dimension of space, worked out in its exponents, each factor once: "m/s m^(d-1)" is
/// "m^2/s" in the plane. A stroke holds for the factor behind it alone.
std::string unit_in_space(const std::string& unit, int dimension);

/// Units of what a run records at each step, as far as somebody declares them: types by Registry::publishes,
/// fields for their unknowns. A pure number has "". In the plane integrals are per metre of depth.
/// @param names of the series
std::map<std::string, std::string> series_units(const Scene& scene, const Registry& registry,
                                                const Problem& problem,
                                                const std::vector<std::string>& names);

}  // namespace seam
