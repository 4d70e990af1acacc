// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "plan.hpp"
#include "report.hpp"

namespace seam::cli {

/// Scene, as a file wherever one stands, and variant.
using VariantName = std::pair<std::filesystem::path, std::string>;
VariantName name_of(const MatrixPlan& plan, const Variant& variant);

/// The folder that a matrix writes to: one at a time, and never into what is not its own. Its table remembers
/// what came of each variant until that is run again.
class MatrixFolder {
 public:
  /// Makes the folder where there is none, and takes its lock.
  /// @throws Error when another matrix is at work in it, or something else has written to it
  explicit MatrixFolder(std::filesystem::path path);
  ~MatrixFolder();
  MatrixFolder(const MatrixFolder&) = delete;
  MatrixFolder& operator=(const MatrixFolder&) = delete;

  /// What failed, or was not run, when it was to be run last, of these scenes.
  /// @throws Error when there is no table, or one names a variant that a scene does not have any more
  [[nodiscard]] std::set<VariantName> failed_last_time(const std::vector<MatrixPlan>& plans) const;

  /// An empty folder for a variant. @throws Error also when a link is in the way
  void make_new(const std::filesystem::path& folder) const;

  /// Writes the table matrix.json, which keeps what it says of variants that these scenes still have and that
  /// are not among the results, and of other scenes. Also before anything runs: what is interrupted is to be
  /// told from what passed.
  void write_table(const std::vector<VariantResult>& results, const std::vector<MatrixPlan>& plans) const;
  /// Writes it, and the tables of these results alone, for people and for continuous integration.
  void write(const std::vector<VariantResult>& results, const std::vector<MatrixPlan>& plans,
             const std::vector<std::pair<std::string, std::string>>& circumstances) const;

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace seam::cli
