// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/run_command.hpp"
#include "series.hpp"

namespace seam_cli_test {

/// A run of a scene that is written out, in a folder that goes with it.
struct Run {
  /// @param before the command, as of seam()
  explicit Run(const std::string& text, const std::string& options = "", const std::string& before = "") {
    done = seam("run " + folder.file("scene.yaml", text) + " --no-picture --folder " +
                    (folder.path / "out").string() + " " + options,
                before);
  }
  [[nodiscard]] std::vector<double> series(const std::string& name) const {
    return column(folder.read("out/series.csv"), name);
  }
  Folder folder;
  Result done;
};

}  // namespace seam_cli_test
