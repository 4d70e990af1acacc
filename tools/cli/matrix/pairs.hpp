// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <vector>

#include "plan.hpp"

namespace seam::cli {

/// Of these variants few that hold, between them, each pair of values of two keys that any of them holds:
/// greedily, so not always the fewest that there are.
/// @param whole keys that are not chosen from: of what is taken, all variants are that differ in these alone
std::vector<Variant> fewest_with_all_pairs(const std::set<std::size_t>& whole, std::vector<Variant> variants);

}  // namespace seam::cli
