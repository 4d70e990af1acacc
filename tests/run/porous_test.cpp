// SPDX-License-Identifier: BSD-3-Clause
// configs/poro/squeezed_column.yaml: what leaves the pores has left the body.
#include <cmath>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;

TEST_CASE("a porous body loses in each step what flows out of it, at any strain") {
  const Folder folder;
  const Result run = seam("verify " SEAM_SOURCE_DIR "/configs/poro/squeezed_column.yaml --quiet --folder " +
                          folder.path.string());
  INFO(run.output);
  REQUIRE(run.code == 0);
  const std::string series = folder.read("series.csv");
  const std::vector<double> time = column(series, "time"), volume = column(series, "column.fluid_volume"),
                            outflow = column(series, "outflow");
  REQUIRE(time.size() > 50);
  CHECK(volume.back() < 0.4 * volume.front());
  for (std::size_t k = 1; k < time.size(); ++k)
    CHECK(std::abs(volume[k - 1] - volume[k] - (time[k] - time[k - 1]) * outflow[k]) < 1e-9 * volume.front());
}
