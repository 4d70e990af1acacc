// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "seam/base/communicator.hpp"
#include "seam/output/pvd.hpp"
#include "seam/output/vtu.hpp"

namespace seam {

/// A time series of pieces: NAME.pvd in a folder, and for every step a file in its subfolder `fields`; with
/// several ranks a .pvtu file that joins those of all ranks.
class PieceSeries {
 public:
  /// @param resume_time keep what an existing series holds up to this time; negative: start afresh
  PieceSeries(const Communicator& communicator, std::filesystem::path folder, std::string name,
              double resume_time);
  /// Collective; the caller waits for all ranks before it counts on the files. All pieces have the same
  /// arrays.
  void write(long step_number, double time, const VtuPiece& piece);

 private:
  Communicator communicator_;
  std::filesystem::path folder_;
  std::string name_;
  PvdSeries series_;
};

}  // namespace seam
