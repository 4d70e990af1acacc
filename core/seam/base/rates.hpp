// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>

namespace seam {

/// First and second rate of a function of time, from its values at times before: at a kink those of the past.
/// Where it has none there, as the root of t at 0, those of what follows; no number where it has none there
/// either. Smooth functions: to about 1e-11 and 1e-8 of their size over the time in which they change.
std::array<double, 2> rates_of(const std::function<double(double)>& function, double time);

}  // namespace seam
