// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace seam {

/// What a domain of integration may be, too: one that looks at where its points were at the start of a step.
class BeginsSteps {
 public:
  virtual ~BeginsSteps() = default;
  /// Called before a step is predicted, while states are those at its start. Collective.
  /// @param from the start of the step, s
  virtual void begin_step(double from) = 0;
};

}  // namespace seam
