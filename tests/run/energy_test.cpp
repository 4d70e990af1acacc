// SPDX-License-Identifier: BSD-3-Clause
// Energy of a body that swings freely: nothing is fed in, so implicit Euler may only lose and the trapezoidal
// rule must nearly keep it.
#include <cmath>
#include <sstream>

#include "cli/run_command.hpp"

using namespace seam_cli_test;

namespace {

const std::string free_swing =
    "title: A beam that swings freely\ndimension: 2\nplugins: [solid]\nparameters: {theta: 1}\n"
    "meshes: {beam: {grid: {from: [0, 0], to: [1, 0.1], cells: [10, 2]}}}\n"
    "fields:\n  beam:\n    type: solid\n    mesh: beam\n    order: 2\n    density: 1000\n"
    "    material: {type: neo_hookean, young: 1e5, poisson: 0.3}\n"
    "    boundary: [{on: x_min, displacement: [0, 0]}]\n    initial: {velocity: [0, 0.5*x^2]}\n"
    "time: {theta: \"${theta}\", end: 0.5, step: {initial: 0.005}}\n"
    "solver: {newton: {tolerance: 1e-10}}\noutput: {fields: false}\n";

/// Kinetic plus strain energy at every step.
std::vector<double> energies(const Folder& folder, const std::string& theta) {
  const std::string file = folder.file("swing.yaml", free_swing);
  REQUIRE(
      seam("run " + file + " --quiet --set parameters.theta=" + theta + " --folder " + folder.path.string())
          .code == 0);
  std::istringstream in(folder.read("series.csv"));
  std::string line;
  std::getline(in, line);
  REQUIRE_THAT(line, Catch::StartsWith("time,beam.kinetic_energy,beam.strain_energy"));
  std::vector<double> total;
  while (std::getline(in, line)) {
    double time = 0, kinetic = 0, strain = 0;
    REQUIRE(std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &kinetic, &strain) == 3);
    total.push_back(kinetic + strain);
  }
  return total;
}

}  // namespace

TEST_CASE("implicit Euler never gains energy") {
  const Folder folder;
  const auto e = energies(folder, "1");
  REQUIRE(e.size() == 101);
  for (std::size_t k = 1; k < e.size(); ++k) CHECK(e[k] <= e[k - 1] * (1 + 1e-9));
  CHECK(e.back() < 0.995 * e.front());
}

TEST_CASE("the trapezoidal rule nearly keeps the energy", "[study]") {
  const Folder folder;
  const auto e = energies(folder, "0.5");
  for (const double value : e) CHECK(value == Approx(e.front()).epsilon(2e-3));
}
