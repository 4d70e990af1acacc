// SPDX-License-Identifier: BSD-3-Clause
// What couplings measure point by point, against what is recorded of the same measures.
#include <algorithm>
#include <cmath>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;

TEST_CASE("tables of an interface's points add up to what is recorded, on any number of ranks") {
  for (const std::string before : {"", "mpirun --oversubscribe -np 2"}) {
    const Folder folder;
    const Result run =
        seam("run " SEAM_SOURCE_DIR
             "/plugins/nitsche_fsci/conformance/contact_in_fluid.yaml --quiet --no-picture --set "
             "output.interfaces=true --set output.every=100 --folder " +
                 folder.path.string(),
             before);
    INFO(run.output);
    REQUIRE(run.code == 0);
    const std::string series = folder.read("series.csv"), table = folder.read("interfaces/down-00000012.csv");
    const auto last = [&](const std::string& name) { return column(series, name).back(); };
    const std::vector<double> weight = column(table, "weight"), pull = column(table, "force.y"),
                              gap = column(table, "gap"), touch = column(table, "contact_area");
    double force = 0, area = 0, least = INFINITY;
    for (std::size_t q = 0; q < weight.size(); ++q) {
      force += weight[q] * pull[q];
      if (std::isnan(gap[q])) continue;  // far from all other bodies
      area += weight[q] * touch[q];
      least = std::min(least, gap[q]);
    }
    CHECK(area > 0);
    CHECK(area == Approx(last("down.contact_area")).epsilon(1e-7));
    CHECK(force == Approx(last("down.force.y")).epsilon(1e-7));
    CHECK(least == Approx(last("down.gap")).epsilon(1e-7));
    CHECK(column(table, "time").front() == Approx(last("time")));
  }
}

TEST_CASE("a scene whose couplings measure nothing has no tables of interfaces to write") {
  const Folder folder;
  const Result run =
      seam("run " SEAM_SOURCE_DIR
           "/configs/solid/patch_2d.yaml --quiet --no-picture --set output.interfaces=true --folder " +
           folder.path.string());
  CHECK(run.code != 0);
  CHECK_THAT(run.output, Catch::Contains("no coupling measures anything"));
}
