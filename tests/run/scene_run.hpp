// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/run_command.hpp"
#include "series.hpp"

namespace seam_cli_test {

/// A run of a scene that is written out, in a folder that goes with it.
struct Run {
  /// @param before the command, as of seam()
  explicit Run(const std::string& text, const std::string& options = "", const std::string& before = "");
  [[nodiscard]] std::vector<double> series(const std::string& name) const;
  Folder folder;
  Result done;
};

/// A run of a scene of configs/ that comes to its end, with checks that hold.
class ShippedRun {
 public:
  /// @param before the command, as of seam()
  explicit ShippedRun(const std::string& scene, const std::string& options = "",
                      const std::string& before = "");
  [[nodiscard]] std::vector<double> series(const std::string& name) const;
  /// At the end.
  [[nodiscard]] double operator()(const std::string& name) const;
  [[nodiscard]] std::string summary() const;
  std::string csv;

 private:
  Folder folder_;
};

}  // namespace seam_cli_test
