// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace seam {

/// Part of a value that counts as its change in a step, in what residuals and increments are compared with.
/// In a steady state nothing changes, and a unidirectional flow has div v = 0 at every point: equations would
/// be measured by their own rounding, increments by noise.
inline constexpr double steady_part = 1e-6;

}  // namespace seam
