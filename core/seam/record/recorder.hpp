// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "seam/record/restart.hpp"
#include "seam/solve/newton.hpp"

namespace seam {

/// Where a run stands, as its recorders are told.
struct Standing {
  const RunState& state;  ///< the last good one
  TimePoint at;           ///< of that
  double part;            ///< of the run's time that is done, 0 to 1
  double seconds;         ///< since this process began to run the scene
};

/// A step that was tried.
struct Attempt {
  double length;  ///< s
  const NewtonReport& report;
};

/// Writes down how a run goes. Whoever drives a session tells its recorders, in the order in which they were
/// added, the same on all ranks: every call is collective.
class Recorder {
 public:
  Recorder() = default;
  virtual ~Recorder() = default;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Before the first step of this process. @param resumed the state is that of a restart point
  virtual void begin(const Standing& /*now*/, bool /*resumed*/) {}
  /// A step was taken, which led here.
  virtual void take(const Standing& /*now*/, const Attempt& /*last*/) {}
  /// A step from here was refused.
  virtual void refuse(const Standing& /*now*/, const Attempt& /*last*/) {}
  /// Nothing follows for now: the state is to be on disk, whatever the scene says of intervals.
  virtual void keep(const Standing& /*now*/) {}
  /// The last call. @param status, reason as in the summary
  virtual void end(const Standing& /*now*/, const std::string& /*status*/, const std::string& /*reason*/) {}
};

}  // namespace seam
