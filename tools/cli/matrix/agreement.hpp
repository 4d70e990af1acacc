// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "plan.hpp"
#include "variant_run.hpp"

namespace seam::cli {

/// Compares the series of variants that must agree, each with those of the first of its group that came to
/// its end and is to pass; adds what it finds to the results.
/// @param results of the plan's variants, in their order; null for those that were not run
/// @param folder_of results of a variant
void compare(const MatrixPlan& plan, const std::vector<VariantResult*>& results,
             const std::function<std::filesystem::path(std::size_t variant)>& folder_of);

}  // namespace seam::cli
