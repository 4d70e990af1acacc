// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/assembly/time_point.hpp"

namespace seam {

/// What a constraint may be, too: one that some cuts of its field's mesh do not go with.
class WatchesCut {
 public:
  virtual ~WatchesCut() = default;
  /// Called whenever meshes have been cut anew. Collective.
  /// @throws Error on all ranks where a cut cannot be; StepRefused where it is that of a step
  virtual void look_at_cut(const TimePoint& at) const = 0;
};

}  // namespace seam
