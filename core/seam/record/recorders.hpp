// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "seam/base/stopwatch.hpp"
#include "seam/output/results_folder.hpp"
#include "seam/record/recorder.hpp"
#include "seam/scene/scene.hpp"

namespace seam {

class FieldOutput;
class CutOutput;
class InterfaceOutput;
class SeriesFile;
class EventFile;

/// Fields, interface points and the cut itself for ParaView, at the intervals of the scene.
class PictureRecorder final : public Recorder {
 public:
  /// @param resume_time keep what existing series hold up to this time; negative: start afresh
  PictureRecorder(const Scene& scene, Problem& problem, ResultsFolder& folder, double resume_time);
  ~PictureRecorder() override;
  void begin(const Standing& now, bool resumed) override;
  void take(const Standing& now, const Attempt& last) override;
  void keep(const Standing& now) override;

 private:
  void write(const Standing& now);
  long every_;
  long last_ = -1;  ///< step number of what was written last
  std::unique_ptr<FieldOutput> fields_;
  std::unique_ptr<CutOutput> cut_;
  std::unique_ptr<InterfaceOutput> points_;
};

/// series.csv and events.jsonl.
class LogRecorder final : public Recorder {
 public:
  LogRecorder(const Communicator& communicator, ResultsFolder& folder);
  ~LogRecorder() override;
  void begin(const Standing& now, bool resumed) override;
  void take(const Standing& now, const Attempt& last) override;
  void refuse(const Standing& now, const Attempt& last) override;
  void end(const Standing& now, const std::string& status, const std::string& reason) override;

 private:
  Communicator communicator_;
  std::unique_ptr<SeriesFile> series_;  ///< on rank 0
  std::unique_ptr<EventFile> events_;   ///< on rank 0
};

/// Restart points, by steps as the scene says; by the clock when told to keep().
class RestartRecorder final : public Recorder {
 public:
  RestartRecorder(const Scene& scene, const Problem& problem, ResultsFolder& folder);
  void take(const Standing& now, const Attempt& last) override;
  void keep(const Standing& now) override;
  /// Whether the scene's minutes since the last one are over, by this rank's clock.
  [[nodiscard]] bool due_by_clock() const { return minutes_ > 0 && watch_.seconds() > 60 * minutes_; }

 private:
  const Problem& problem_;
  ResultsFolder& folder_;
  double minutes_;
  long every_;
  std::size_t most_;  ///< that are kept
  long last_ = -1;    ///< step number of the newest of this process
  Stopwatch watch_;   ///< since then
};

/// A line on the terminal for each step.
class ProgressRecorder final : public Recorder {
 public:
  void take(const Standing& now, const Attempt& last) override;
};

}  // namespace seam
