// SPDX-License-Identifier: BSD-3-Clause
// Porous bodies alone against a solution that is known exactly: finite strain, porosity that changes, in the
// plane and in space.
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/run_command.hpp"

using namespace seam_cli_test;

namespace {

using Errors = std::map<std::string, double>;

Errors errors(const std::string& scene, const std::string& overrides) {
  const Folder folder;
  const Result run = seam("run " SEAM_SOURCE_DIR "/configs/poro/" + scene +
                          ".yaml --quiet --no-picture --set output.fields=false --set checks=[] --folder " +
                          folder.path.string() + overrides);
  INFO(run.output);
  REQUIRE(run.code == 0);
  return nlohmann::json::parse(folder.read("summary.json")).at("results").get<Errors>();
}

double order(const Errors& coarse, const Errors& fine, const std::string& norm) {
  return std::log2(coarse.at(norm) / fine.at(norm));
}

void check_orders(const std::string& scene, const std::string& cell, int order_of_cells, int n,
                  const std::string& more = "") {
  INFO(cell << " of order " << order_of_cells << more);
  const std::string how = more + " --set meshes.block.grid.cell=" + cell +
                          " --set parameters.order=" + std::to_string(order_of_cells) +
                          " --set parameters.n=";
  const Errors coarse = errors(scene, how + std::to_string(n)),
               fine = errors(scene, how + std::to_string(2 * n));
  // The pressure, of order 1 in both, loads the skeleton.
  CHECK(order(coarse, fine, "u.l2") > 1.9);
  CHECK(order(coarse, fine, "u.h1") > order_of_cells - 0.1);
  // v is as good as grad p at least.
  CHECK(order(coarse, fine, "p.h1") > 0.9);
  CHECK(order(coarse, fine, "v.l2") > (cell == "triangle" ? 0.9 : 1.4));
  CHECK(order(coarse, fine, "p.l2") > (order_of_cells == 2 ? 1.9 : 1.5));
}

}  // namespace

TEST_CASE("a porous body of changing porosity converges with the expected orders", "[study]") {
  check_orders("waves", "quadrilateral", 1, 8);
  check_orders("waves", "triangle", 1, 8);
  check_orders("waves", "quadrilateral", 2, 4);
  check_orders("waves", "triangle", 2, 4);
  check_orders("waves_3d", "hexahedron", 1, 3);
  check_orders("waves_3d", "tetrahedron", 1, 2);
  check_orders("waves_3d", "hexahedron", 2, 2);
}

TEST_CASE("so it does with the interior penalty, at twice the error of the pressure", "[study]") {
  const std::string interior = " --set fields.block.stabilisation.method=interior";
  check_orders("waves", "quadrilateral", 1, 8, interior);
  check_orders("waves", "triangle", 1, 8, interior);
  check_orders("waves_3d", "hexahedron", 1, 3, interior);
  check_orders("waves_3d", "tetrahedron", 1, 2, interior);
  CHECK(errors("waves", "").at("p.l2") < 0.6 * errors("waves", interior).at("p.l2"));
}

TEST_CASE("a porous body of changing porosity converges with orders 1 and 2 in time", "[study]") {
  const auto at = [](const std::string& scheme, const std::string& storage, const std::string& step) {
    return errors("waves",
                  " --set functions.exact.in_space=straight --set functions.exact.in_time=wavy --set "
                  "parameters.frequency=2 --set parameters.n=4 --set fields.block.storage=" +
                      storage + " --set 'time={" + scheme + ", end: 1, step: {initial: " + step + "}}'");
  };
  const auto check = [&](const std::string& scheme, const std::string& storage, double expected,
                         const std::string& coarse_step, const std::string& fine_step) {
    INFO(scheme << ", " << storage);
    const Errors coarse = at(scheme, storage, coarse_step), fine = at(scheme, storage, fine_step);
    for (const auto* norm : {"u.l2", "v.l2", "p.l2"}) {
      INFO(norm << " " << coarse.at(norm) << " -> " << fine.at(norm));
      CHECK(order(coarse, fine, norm) > expected - 0.15);
    }
  };
  for (const std::string storage : {"chain_rule", "conservative"}) {
    check("theta: 1", storage, 1, "0.05", "0.025");
    check("theta: 0.5", storage, 2, "0.1", "0.05");
  }
}
