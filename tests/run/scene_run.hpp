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

/// A run of a scene of configs/ that comes to its end, with checks that hold.
class ShippedRun {
 public:
  /// @param before the command, as of seam()
  explicit ShippedRun(const std::string& scene, const std::string& options = "",
                      const std::string& before = "") {
    const Result done =
        seam("run " SEAM_SOURCE_DIR "/configs/" + scene + ".yaml --no-picture --quiet --folder " +
                 (folder_.path / "out").string() + " --set output.fields=false " + options,
             before);
    INFO(done.output);
    REQUIRE(done.code == 0);
    csv = folder_.read("out/series.csv");
  }
  [[nodiscard]] std::vector<double> series(const std::string& name) const { return column(csv, name); }
  /// At the end.
  [[nodiscard]] double operator()(const std::string& name) const { return series(name).back(); }
  [[nodiscard]] std::string summary() const { return folder_.read("out/summary.json"); }
  std::string csv;

 private:
  Folder folder_;
};

}  // namespace seam_cli_test
