// SPDX-License-Identifier: BSD-3-Clause
#include "scene_run.hpp"

namespace seam_cli_test {

Run::Run(const std::string& text, const std::string& options, const std::string& before) {
  done = seam("run " + folder.file("scene.yaml", text) + " --no-picture --folder " +
                  (folder.path / "out").string() + " " + options,
              before);
}

std::vector<double> Run::series(const std::string& name) const {
  return column(folder.read("out/series.csv"), name);
}

ShippedRun::ShippedRun(const std::string& scene, const std::string& options, const std::string& before) {
  const Result done =
      seam("run " SEAM_SOURCE_DIR "/configs/" + scene + ".yaml --no-picture --quiet --folder " +
               (folder_.path / "out").string() + " --set output.fields=false " + options,
           before);
  INFO(done.output);
  REQUIRE(done.code == 0);
  csv = folder_.read("out/series.csv");
}

std::vector<double> ShippedRun::series(const std::string& name) const { return column(csv, name); }

double ShippedRun::operator()(const std::string& name) const { return series(name).back(); }

std::string ShippedRun::summary() const { return folder_.read("out/summary.json"); }

}  // namespace seam_cli_test
