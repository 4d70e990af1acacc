// SPDX-License-Identifier: BSD-3-Clause
// Porous bodies in a flow: what leaves the fluid has entered the body.
#include <algorithm>
#include <cmath>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;

namespace {

/// The series of a run of configs/poro/<scene>.yaml, whose checks hold.
std::string series_of(const std::string& scene, const Folder& folder, const std::string& more = "") {
  const Result run =
      seam("run " SEAM_SOURCE_DIR "/configs/poro/" + scene + ".yaml --quiet --no-picture --folder " +
           folder.path.string() + " --set output.fields=false " + more);
  INFO(run.output);
  REQUIRE(run.code == 0);
  return folder.read("series.csv");
}

}  // namespace

TEST_CASE("a body that bends in a flow stores in each step what seeps into it") {
  SECTION("a filter") {
    const Folder folder;
    const std::string series = series_of("filter", folder);
    const std::vector<double> time = column(series, "time"), volume = column(series, "filter.fluid_volume"),
                              seepage = column(series, "face.seepage"), missing = column(series, "missing");
    REQUIRE(time.size() > 25);
    CHECK(*std::max_element(volume.begin(), volume.end()) > 1.02 * volume.front());
    for (std::size_t k = 1; k < time.size(); ++k) {
      CHECK(std::abs(volume[k] - volume[k - 1] - (time[k] - time[k - 1]) * seepage[k]) < 1e-8);
      CHECK(std::abs(missing[k]) < 1e-8);
    }
  }
  SECTION("a beam whose outline has no names") {
    const Folder folder;
    const std::string series =
        series_of("bending_beam", folder,
                  "--set checks=[] --set output.statistics={} --set parameters.m=2 --set parameters.h=0.03 "
                  "--set parameters.step=0.1 --set parameters.end=2.8");
    const auto of = [&](const std::string& name) { return column(series, name); };
    const std::vector<double> time = of("time"), volume = of("beam.fluid_volume"),
                              seepage = of("face.seepage"), missing = of("missing");
    REQUIRE(time.size() == 29);
    for (std::size_t k = 1; k < time.size(); ++k) {
      CHECK(std::abs(volume[k] - volume[k - 1] - (time[k] - time[k - 1]) * seepage[k]) < 1e-8);
      CHECK(std::abs(missing[k]) < 1e-7);
    }
    // It bends with the flow, is stretched before and pressed behind, and fluid seeps through it.
    CHECK(of("tip.x").back() > 0.3);
    CHECK(of("phi_before").back() > 0.505);
    CHECK(of("phi_behind").back() < 0.495);
    CHECK(of("across").back() > 1e-4);
  }
}

TEST_CASE("fluid slips along a porous bed after Beavers and Joseph, after Saffmann, and not at all") {
  SECTION("over a length") {
    const std::string saffmann = "--set coupling.0.slip_against=skeleton ";
    for (const std::string tangential : {"nitsche", "substitution"}) {
      const std::string how = "--set coupling.0.tangential=" + tangential + " --set checks=[] ";
      const Folder first, second;
      CHECK(column(series_of("beavers_joseph", first, how), "slip").back() ==
            Approx(0.0545454545).epsilon(5e-3));
      CHECK(column(series_of("beavers_joseph", second, how + saffmann), "slip").back() ==
            Approx(0.0454545455).epsilon(5e-3));
    }
  }
  SECTION("of none, whatever the permeability") {
    const std::string permeability = GENERATE("[1e-2]", "[1e-10]", "[1e-19]");
    for (const std::string method : {"interior", "residual"}) {
      const Folder folder;
      const std::string series =
          series_of("beavers_joseph", folder,
                    "--set coupling.0.alpha=.inf --set coupling.0.slip_against=skeleton --set "
                    "checks=[] --set fields.bed.stabilisation.method=" +
                        method + " --set fields.bed.permeability=" + permeability);
      // Between two walls: G/(8 mu) in the middle.
      CHECK(std::abs(column(series, "slip").back()) < 1e-4);
      CHECK(column(series, "fastest").back() == Approx(0.5 * 0.4454545 * (1 - 0.4454545)).epsilon(5e-3));
    }
  }
}
