// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/output/piece_series.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// Writes how bodies cut the fields' meshes, three time series per field that is cut:
/// - FIELD-cells: all background cells with their state and the share of them that is wet;
/// - FIELD-interface: the points at which the interface is integrated;
/// - FIELD-ghost_faces: the faces that the ghost penalty holds together.
class CutOutput {
 public:
  /// @param resume_time as for PieceSeries
  CutOutput(Problem& problem, ResultsFolder& folder, double resume_time);
  /// True when some field is cut.
  /// Collective.
  void write(long step_number, const TimePoint& at);

 private:
  struct Series {
    const FieldEntry* entry;
    PieceSeries cells, interface, ghost_faces;
  };
  Communicator communicator_;
  std::vector<Series> fields_;
};

}  // namespace seam
