// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "seam/base/communicator.hpp"
#include "seam/output/pvd.hpp"
#include "seam/output/results_folder.hpp"
#include "seam/output/vtu.hpp"

namespace seam {

/// A time series of pieces: NAME.pvd in a folder, and for every step a file in its subfolder `fields`; with
/// several ranks a .pvtu file that joins those of all ranks.
class PieceSeries {
 public:
  /// @param resume_time keep what an existing series holds up to this time; negative: start afresh
  /// Collective. @throws FileError on all ranks
  PieceSeries(const Communicator& communicator, ResultsFolder& folder, std::string name, double resume_time);
  /// Collective. All pieces have the same arrays. @throws FileError on all ranks
  void write(long step_number, double time, const VtuPiece& piece);

 private:
  /// Of one rank's piece.
  [[nodiscard]] std::string piece_name(const std::string& stem, int rank) const;
  void claim(const std::string& stem, long step_number);
  void write_files(const std::string& stem, double time, const VtuPiece& piece);
  Communicator communicator_;
  ResultsFolder* folder_;
  std::string name_;
  PvdSeries series_;
};

}  // namespace seam
