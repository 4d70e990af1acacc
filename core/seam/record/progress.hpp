// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace seam {

struct Progress {
  long step;
  double time;
  int iterations;
  int shares;        ///< in which what acts was raised, 0 where it acted at once
  double part_done;  ///< in [0, 1]
  double seconds;    ///< since the start
};

/// Writes one line to stderr: overwriting the last one on a terminal, else at most one every ten seconds.
void print_progress(const Progress& progress);

}  // namespace seam
