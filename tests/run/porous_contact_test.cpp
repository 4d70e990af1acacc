// SPDX-License-Identifier: BSD-3-Clause
// A porous column that presses a film of fluid through its pores, and stands on the wall in the end.
#include <algorithm>
#include <cmath>

#include "scene_run.hpp"

using namespace seam_cli_test;

TEST_CASE("a porous column closes a film of fluid that can only drain through it", "[sanitized]") {
  SECTION("what the film loses the pores get, and forces balance, in each step") {
    const ShippedRun run("poro/falling_column", "--set checks=[] --set parameters.end=4");
    const std::vector<double> time = run.series("time"), film = run.series("water.volume"),
                              pores = run.series("column.fluid_volume"), seepage = run.series("foot.seepage"),
                              out = run.series("out"), force = run.series("foot.force.y");
    REQUIRE(time.size() > 35);
    for (std::size_t k = 1; k < time.size(); ++k) {
      const double step = time[k] - time[k - 1];
      CHECK(std::abs(film[k] - film[k - 1] + step * seepage[k]) < 1e-12 * film.front());
      CHECK(std::abs(pores[k] - pores[k - 1] - step * (seepage[k] - out[k])) < 1e-12 * pores.front());
      CHECK(std::abs(force[k] / (0.05 * 0.127) - 1) < 1e-8);
    }
    CHECK(film.back() < 0.9 * film.front());
  }
  SECTION("with a sudden seal it closes when the film has drained, and consolidates on a tight wall") {
    const ShippedRun run(
        "poro/falling_column",
        "--set checks=[] --set output.statistics={} --set parameters.end=11 --set "
        "parameters.gap=2e-4 --set parameters.step=0.05 --set 'coupling.0.seal={by: switch}'");
    const std::vector<double> time = run.series("time"), base = run.series("base"),
                              film = run.series("water.volume"), contact = run.series("foot.contact_force.y");
    // 2e-4 mu/(K q) = 4 s.
    const auto closed = std::ranges::find_if(contact, [](double force) { return force > 0; });
    REQUIRE(closed != contact.end());
    CHECK(time[closed - contact.begin()] == Approx(4).margin(0.15));
    CHECK(film.back() == 0);
    CHECK(contact.back() == Approx(0.05 * 0.127).epsilon(1e-8));
    // Diffusion in a column that was drained at its foot until then.
    const auto at = [&](double wanted) {
      return base[std::ranges::lower_bound(time, wanted - 1e-6) - time.begin()];
    };
    CHECK(at(5.5) == Approx(0.03555).epsilon(0.04));
    CHECK(at(7.5) == Approx(0.02783).epsilon(0.04));
    CHECK(at(10.5) == Approx(0.01994).epsilon(0.04));
  }
  SECTION("the seal of the thesis loses fluid, and says so") {
    const ShippedRun run("poro/falling_column",
                         "--set checks=[] --set parameters.end=4 --set 'coupling.0.seal={by: smoothing}'");
    CHECK(std::abs(run("foot.dropped")) > 0.05 * std::abs(run("foot.seepage")));
  }
  SECTION("a second word on what passes through its surface is refused") {
    const Result seepage = seam("run " SEAM_SOURCE_DIR
                                "/configs/poro/falling_column.yaml --set 'fields.column.boundary.1={on: "
                                "y_min, seepage: 0}'");
    CHECK(seepage.code != 0);
    CHECK_THAT(seepage.output,
               Catch::Contains("says what passes through boundary 'y_min' of field 'column', and "
                               "so does a condition there on"));
    const Result stress =
        seam("run " SEAM_SOURCE_DIR "/configs/poro/falling_column.yaml --set coupling.1.stress=own");
    CHECK(stress.code != 0);
    CHECK_THAT(stress.output, Catch::Contains("write `stress: other`"));
  }
}
