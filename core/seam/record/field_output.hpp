// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/output/piece_series.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// Writes the fields of a problem as VTU pieces with one PVD time series per field. Where bodies cut a field,
/// only its own part of a cell is written: as linear triangles or tetrahedra, whatever the field's order.
class FieldOutput {
 public:
  /// @param resume_time keep what existing series hold up to this time; negative: start afresh
  FieldOutput(Problem& problem, ResultsFolder& folder, double resume_time);
  /// Collective.
  void write(long step_number, const TimePoint& at);

 private:
  Problem& problem_;
  std::vector<PieceSeries> series_;  ///< [field]
};

}  // namespace seam
