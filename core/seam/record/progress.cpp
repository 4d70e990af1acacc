// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace seam {

void print_progress(const Progress& p) {
  static double last = -1e9;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const bool finished = p.part_done > 1 - 1e-9;
  if (!terminal && p.seconds - last < 10) return;
  last = p.seconds;
  const double left = p.part_done > 0 ? p.seconds * (1 / p.part_done - 1) : 0;
  fmt::print(stderr, "{}step {:>6}  t = {:<12.6g} {:>2} iterations{}  {:5.1f} %  {:.0f} s left{}",
             terminal ? "\r\033[K" : "", p.step, p.time, p.iterations,
             p.shares > 0 ? fmt::format(", loads raised in {} shares", p.shares) : "", 100 * p.part_done,
             left, terminal && !finished ? "" : "\n");
  std::fflush(stderr);
}

}  // namespace seam
