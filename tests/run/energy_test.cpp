// SPDX-License-Identifier: BSD-3-Clause
// Energy of a body that swings freely: nothing is fed in, so implicit Euler may only lose and the trapezoidal
// rule must nearly keep it; and of one that bounces.
#include <algorithm>
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

/// Kinetic plus strain energy at every step of a body, in a run's first columns.
std::vector<double> recorded(const Folder& folder, const std::string& body) {
  std::istringstream in(folder.read("series.csv"));
  std::string line;
  std::getline(in, line);
  REQUIRE_THAT(line, Catch::StartsWith("time," + body + ".kinetic_energy," + body + ".strain_energy"));
  std::vector<double> total;
  while (std::getline(in, line)) {
    double time = 0, kinetic = 0, strain = 0;
    REQUIRE(std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &kinetic, &strain) == 3);
    total.push_back(kinetic + strain);
  }
  return total;
}

std::vector<double> energies(const Folder& folder, const std::string& theta) {
  const std::string file = folder.file("swing.yaml", free_swing);
  REQUIRE(
      seam("run " + file + " --quiet --set parameters.theta=" + theta + " --folder " + folder.path.string())
          .code == 0);
  return recorded(folder, "beam");
}

/// Largest energy of a bar that has bounced between two walls ten times, in parts of that at the start.
double most_after_ten_impacts(const std::string& in_time) {
  const Folder folder;
  const std::string settings =
      " --set parameters.n=25 --set parameters.theta=0.5 --set parameters.gap=0.005"
      " --set parameters.behind=0.005 --set parameters.end=17.5 --set coupling.0.penalty=10"
      " --set coupling.0.adjoint=symmetric --set coupling.0.in_time=" +
      in_time;
  // The scene's checks are those of one impact.
  seam("run " SEAM_SOURCE_DIR
       "/configs/contact/bar.yaml --quiet --no-picture --set output.fields=false --folder " +
       folder.path.string() + settings);
  const std::vector<double> e = recorded(folder, "bar");
  REQUIRE(e.size() > 2000);
  return *std::max_element(e.begin(), e.end()) / e.front();
}

}  // namespace

TEST_CASE("implicit Euler never gains energy", "[sanitized]") {
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

TEST_CASE("contact that is cut off over a step feeds no energy in, contact at its end does", "[study]") {
  CHECK(most_after_ten_impacts("hybrid") < 1.01);
  CHECK(most_after_ten_impacts("plain") > 2);
}
