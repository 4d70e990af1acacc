// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "seam/base/communicator.hpp"

namespace seam {

/// While it lives, SIGINT, SIGTERM, SIGHUP and SIGUSR1 do not end the process: they are remembered, and
/// whoever runs asks for them between two steps. A second one ends the process at once, as it would without
/// this; one that comes within half a second of the first counts as the same one, since launchers and batch
/// systems often send both to the same process. Signals that the process ignores (as after `nohup`) stay
/// ignored.
///
/// One at a time.
class SignalWatch {
 public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  /// The signal that was caught, 0 when there was none (or nothing is watched).
  static int caught();
};

/// "SIGTERM" for 15.
std::string signal_name(int signal);

/// What the ranks must know of each other between two steps.
struct Attention {
  int signal = 0;            ///< that some rank has caught; 0 for none
  bool out_of_time = false;  ///< no further step is to be begun
  bool restart_due = false;  ///< a restart point is to be written, by the clock
};

/// What any rank says, on all ranks. Collective: one reduction when there are several ranks.
Attention agree(const Communicator& communicator, const Attention& mine);

/// The seconds of "1h30m", "45m", "90s", "2d", "5400" (a number alone is in seconds).
/// @throws Error when it is something else, or not above 0
double parse_duration(const std::string& text);

}  // namespace seam
