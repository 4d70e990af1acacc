// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace seam::cli {

/// From now on a crash (a segmentation fault and the like) says in whose code it came about: that of which
/// plugin, or Seam's own. The process ends by its signal all the same.
void explain_crashes();

}  // namespace seam::cli
