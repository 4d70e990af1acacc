// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace seam {

/// A .pvd file: the times of a run and the file written at each. It is rewritten as a whole with each entry,
/// and is complete at any moment.
class PvdSeries {
 public:
  PvdSeries() = default;
  /// Starts anew; an existing file is replaced when the first entry comes.
  explicit PvdSeries(std::string path) : path_(std::move(path)) {}
  /// Goes on with an existing file (or starts anew if there is none), without its entries after a time.
  /// @throws Error when the file is there but is no .pvd file
  static PvdSeries resume(const std::string& path, double last_time);

  /// Replaces the last entry when that is of the same time.
  /// @param file relative to the folder of the .pvd file
  /// @throws Error when the file cannot be written
  void add(double time, const std::string& file);
  [[nodiscard]] const std::vector<std::pair<double, std::string>>& entries() const { return entries_; }

 private:
  std::string path_;
  std::vector<std::pair<double, std::string>> entries_;
};

}  // namespace seam
