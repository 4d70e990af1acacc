// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "seam/base/communicator.hpp"
#include "seam/output/safe_file.hpp"
#include "seam/scene/scene.hpp"

namespace seam {

/// How a run treats what is in its folder already.
struct FolderUse {
  bool resume = false;     ///< go on with the run that wrote it
  bool changed = false;    ///< also when the scene says something else now
  bool overwrite = false;  ///< replace it, whatever came of the run that wrote it
};

/// The folder that a run writes to. It belongs to one run at a time (a lock), remembers of which scene
/// (run.json) and what that run wrote (manifest.txt): a later run replaces exactly that, and nothing that is
/// not listed there is ever deleted or overwritten.
///
/// All ranks hold one; the first one acts, the others learn what came of it.
class ResultsFolder {
 public:
  static constexpr long all_steps = -1;                                 ///< of a file of the whole run
  static constexpr long at_the_end = std::numeric_limits<long>::max();  ///< of what speaks of its end

  /// Makes the folder where there is none, and takes its lock. Nothing in it changes before begin().
  /// Collective.
  /// @throws Error when another run is at work in it, when it holds what must not be replaced, or when it is
  /// to be resumed with another scene; FileError when it cannot be written to
  ResultsFolder(const Communicator& communicator, const Scene& scene, std::filesystem::path folder,
                const FolderUse& use);
  /// Gives the lock back. A run that did not call finish() is taken for interrupted.
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Tells this run from all others; kept when it is resumed. The same on all ranks.
  [[nodiscard]] const std::string& run() const { return run_; }
  /// Whether the run goes on that wrote what is here. On rank 0; false elsewhere.
  [[nodiscard]] bool resumes() const { return resumed_; }
  /// Names of those that are listed and there, the newest first. On rank 0; empty elsewhere.
  [[nodiscard]] std::vector<std::string> restart_points() const;
  /// Whether runs write files, and no folders, with such a name.
  [[nodiscard]] static bool is_name_of_file(const std::filesystem::path& name);
  /// Whether the run that is resumed came to its end and left no restart point: to go on would be to begin
  /// anew. Collective.
  [[nodiscard]] bool has_finished() const;

  /// Removes what an earlier run wrote, or what the run that is resumed wrote after this step, and records
  /// the start. Collective.
  /// @param resumed_at step to go on from; none when the run starts afresh
  void begin(std::optional<long> resumed_at);

  /// On rank 0: makes a folder in this one. No effect elsewhere. @throws FileError also when it is a link
  void make_subfolder(const std::string& name) const;
  /// On rank 0: lists a file before it is written, and makes the folder it lies in. No effect elsewhere.
  /// @param name relative to the folder, as "fields/water-000001.vtu"
  /// @param step that it belongs to: when the run is resumed before that it is removed
  /// @throws FileError when there is such a file that this run (or one that may be replaced) did not write
  void claim(const std::string& name, long step = all_steps);
  /// On rank 0: deletes a file that this run wrote. No effect elsewhere, or when it is gone.
  void remove(const std::string& name);

  /// Whether begin() was called: before, nothing in the folder has changed.
  [[nodiscard]] bool has_begun() const { return begun_; }
  /// Records how the run ended: "finished" and "failed" may be replaced by a later run; "stopped",
  /// "interrupted" and "broken" (by what is no fault of the scene, as a full disk) are kept for being
  /// resumed. Collective.
  void finish(const std::string& status);

  /// Whether a folder holds (or is just given) results of another scene than this one.
  [[nodiscard]] static bool belongs_to_another(const std::filesystem::path& folder, const Scene& scene);

 private:
  class Lock;
  struct Record;
  void take(const FolderUse& use);
  void judge(const FolderUse& use);
  void judge_changes(const FolderUse& use);
  void judge_unlisted() const;
  void clear(std::optional<long> resumed_at);
  void read_manifest();
  void rewrite_manifest();
  void write_record(const std::string& status);
  void remove_listed(const std::string& name) const;

  Communicator communicator_;
  const Scene& scene_;
  std::filesystem::path path_;
  std::string run_;
  std::unique_ptr<Lock> lock_;
  std::unique_ptr<Record> record_;  ///< on rank 0, of the run that is (or was) here
  bool overwrite_ = false, resumed_ = false, begun_ = false;
  std::map<std::string, long> files_;  ///< written by this run, or the one before: name and step
  GrowingFile manifest_;
};

}  // namespace seam
