// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace seam {

class Field;

/// What a Physics is, too, whose state at the start has parts that follow from others and that no initial
/// value can say, since constraints bring these to where they are.
class CompletesStart {
 public:
  virtual ~CompletesStart() = default;
  /// Once, when the values and rates at the start are known. `old` has what initial values said.
  virtual void complete_start(Field& field) const = 0;
};

}  // namespace seam
