// SPDX-License-Identifier: BSD-3-Clause
// Fluid on the two sides of a plate that is thinner than a cell.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;

namespace {

/// The corners of a plate across [0, 2] x [0, 1] and beyond, from bottom to top or from left to right.
std::string plate(bool upright, double at, double rise, double thickness) {
  const double low = -0.1, high = upright ? 1.1 : 2.1, length = upright ? 1.0 : 2.0;
  const auto across = [&](double along) { return at + rise * along / length; };
  const auto corner = [&](double along, double shift) {
    return upright ? fmt::format("{{at: [{}, {}]}}", across(along) + shift, along)
                   : fmt::format("{{at: [{}, {}]}}", along, across(along) + shift);
  };
  const std::string corners[4] = {corner(low, 0), corner(low, thickness), corner(high, thickness),
                                  corner(high, 0)};
  return upright ? fmt::format("[{}, {}, {}, {}]", corners[0], corners[1], corners[2], corners[3])
                 : fmt::format("[{}, {}, {}, {}]", corners[0], corners[3], corners[2], corners[1]);
}

/// A scene with its fluid's conditions, the corners of the plate, its velocity and whatever else.
std::string scene(const std::string& conditions, const std::string& corners, const std::string& velocity,
                  const std::string& rest) {
  return fmt::format(R"(
title: Fluid beside a plate thinner than a cell
dimension: 2
plugins: [cutfem_fluid]
parameters: {{n: 7, u: 0.5}}
meshes:
  tank: {{grid: {{from: [0, 0], to: [2, 1], cells: [2*n+1, n]}}}}
fields:
  water:
    type: cutfem_fluid
    mesh: tank
    parts: separate
    density: 1
    viscosity: 0.1
{}
interfaces:
  plate: {{type: cut, field: water, body: {{type: outline, corners: {}}}, motion: {{translation: ["u*t", 0]}}}}
coupling:
  - {{type: fluid_wall, on: plate, velocity: {}}}
{})",
                     conditions, corners, velocity, rest);
}

const std::string exact_solver = "solver: {newton: {tolerance: 1e-11, increment_tolerance: 1e-8}}\n";

struct Run {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;
  [[nodiscard]] double at_end(const std::string& name) const { return column(name).back(); }
  [[nodiscard]] std::vector<double> column(const std::string& name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    REQUIRE(found != names.end());
    std::vector<double> values;
    for (const auto& row : rows) values.push_back(row[found - names.begin()]);
    return values;
  }
};

Run run(const std::string& text, const std::string& more = "", int ranks = 1) {
  const Folder folder;
  const auto result = seam("run " + folder.file("scene.yaml", text) + " --quiet --no-picture --folder " +
                               (folder.path / "run").string() + " " + more,
                           fmt::format("mpirun --oversubscribe -np {}", ranks));
  CAPTURE(more, ranks, result.output);
  REQUIRE(result.code == 0);
  const std::string csv = folder.read("run/series.csv");
  Run r;
  std::istringstream head(csv.substr(0, csv.find('\n')));
  for (std::string name; std::getline(head, name, ',');) r.names.push_back(name);
  r.rows = table(csv);
  return r;
}

std::string still_water(double at, double rise) {
  return scene(R"yaml(    body_force: [0, -10]
    boundary:
      - {on: [y_min, y_max], velocity: [0, 0]}
      - {on: x_min, traction: ["30 - 10*y", 0]}
      - {on: x_max, traction: ["-(3 - 10*y)", 0]})yaml",
               plate(true, at, rise, 0.01), "[0, 0]", exact_solver + R"(output:
  fields: false
  probes:
    left: {field: water, at: [0.45, 0.5], quantity: pressure}
    right: {field: water, at: [1.55, 0.5], quantity: pressure}
)");
}

/// Two streams that a plate across the tank follows: (u, left + 0.3 t) and (u, right + 0.3 t).
std::string streams(double at, double rise) {
  const std::string side = fmt::format("x - {} - {}*y", at + 0.005, rise);
  return scene(fmt::format(R"(    body_force: [0, 0.3]
    initial: {{velocity: [u, "{} < 0 ? 1 : -2"]}}
    boundary:
      - {{on: [x_min, x_max, y_min, y_max], outflow: do_nothing}})",
                           side),
               plate(true, at, rise, 0.01), fmt::format("[u, \"({} - u*t < 0 ? 1 : -2) + 0.3*t\"]", side),
               R"(time: {end: 2, step: {initial: 0.05}}
solver: {newton: {tolerance: 1e-9, increment_tolerance: 1e-4}, linear: {type: direct, keep: 0}}
output:
  fields: false
  restart: {every: 1}
  probes:
    left: {field: water, at: [0.1, 0.5], quantity: velocity, component: y}
    right: {field: water, at: [1.9, 0.5], quantity: velocity, component: y}
    pressure: {field: water, at: [0.1, 0.5], quantity: pressure}
    force: {interface: plate, quantity: force, component: magnitude}
)");
}

/// A plate with free edges, inside the tank, that pushes the fluid along.
std::string paddle(double rise) {
  return scene(R"(    boundary:
      - {on: [y_min, y_max], velocity: [0, 0]}
      - {on: [x_min, x_max], outflow: symmetric})",
               fmt::format("[{{at: [0.4, 0.2]}}, {{at: [0.41, 0.2]}}, {{at: [{}, 0.8]}}, {{at: [{}, 0.8]}}]",
                           0.41 + rise, 0.4 + rise),
               "[u, 0]", R"(time: {end: 2, step: {initial: 0.05}}
solver: {newton: {tolerance: 1e-11, increment_tolerance: 1e-7}, linear: {type: direct, keep: 0}}
output:
  fields: false
  probes:
    in: {field: water, on: [x_min], quantity: velocity, component: x}
    out: {field: water, on: [x_max], quantity: velocity, component: x}
    force: {interface: plate, quantity: force, component: magnitude}
)");
}

std::string shear_in_space(const std::string& parts) {
  return fmt::format(R"(
title: Two shear flows beside a plate
dimension: 3
plugins: [cutfem_fluid]
meshes:
  tank: {{grid: {{from: [0, 0, 0], to: [1.5, 1, 1], cells: [6, 5, 5]}}}}
fields:
  water:
    type: cutfem_fluid
    mesh: tank
    parts: {}
    density: 1
    viscosity: 0.7
    boundary:
      - {{on: z_min, velocity: [0, 0, 0]}}
      - {{on: z_max, velocity: [-1, 0, 0]}}
      - {{on: [x_min, x_max, y_min, y_max], outflow: do_nothing}}
interfaces:
  plate:
    type: cut
    field: water
    body: {{type: box, from: [-0.3, -0.3, 0.45], to: [1.8, 1.3, 0.46]}}
    motion: {{rotation: "0.05", axis: [1, -2, 0], about: [0.7, 0.5, 0.455]}}
coupling:
  # The middle of the plate after the rotation.
  - {{type: fluid_wall, on: plate, velocity: ["z - 0.455 < tan(0.05)*(2*(x - 0.7) + (y - 0.5))/sqrt(5) ? 2*z : 2 - 3*z", 0, 0]}}
{}output:
  fields: false
  probes:
    low: {{field: water, at: [1.3, 0.3, 0.3], quantity: velocity, component: x}}
    high: {{field: water, at: [1.3, 0.3, 0.7], quantity: velocity, component: x}}
    pressure: {{field: water, at: [1.3, 0.3, 0.7], quantity: pressure}}
)",
                     parts, exact_solver);
}

}  // namespace

TEST_CASE("water rests on two levels beside a plate, exactly and only with parts that are told apart",
          "[study]") {
  // In the second case the plate's right side lies on faces of cells.
  for (const auto& [at, rise] : {std::pair{1.0, 0.05}, std::pair{16.0 / 15 - 0.01, 0.0}, std::pair{0.9, 0.2}})
    for (const std::string cell : {"quadrilateral", "triangle"})
      for (const int order : {1, 2})
        for (const int ranks : {1, 2, 3}) {
          if (ranks > 1 && (order == 2) == (cell == "triangle")) continue;
          const Run r = run(
              still_water(at, rise),
              fmt::format("--set parameters.u=0 --set meshes.tank.grid.cell={} --set fields.water.order={}",
                          cell, order),
              ranks);
          CAPTURE(at, rise, cell, order, ranks);
          CHECK(r.at_end("left") == Approx(25).epsilon(1e-11));
          CHECK(r.at_end("right") == Approx(-2).epsilon(1e-10));
          CHECK(r.at_end("water.kinetic_energy") < 1e-20);
        }
  const Run joined = run(still_water(1.0, 0.05), "--set parameters.u=0 --set fields.water.parts=joined");
  CHECK(std::abs(joined.at_end("left") - 25) > 0.5);
  CHECK(joined.at_end("water.kinetic_energy") > 1e-3);
}

TEST_CASE("two shear flows beside a plate do not mix", "[study]") {
  const std::string text = scene(R"(    boundary:
      - {on: y_min, velocity: [0, 0]}
      - {on: y_max, velocity: [-1, 0]}
      - {on: [x_min, x_max], outflow: do_nothing})",
                                 plate(false, 0.44, 0.06, 0.01),
                                 R"(["y < 0.445 + 0.03*x ? 2*y : 2 - 3*y", 0])", exact_solver + R"(output:
  fields: false
  probes:
    low: {field: water, at: [1.3, 0.3], quantity: velocity, component: x}
    high: {field: water, at: [1.3, 0.7], quantity: velocity, component: x}
    pressure: {field: water, at: [1.3, 0.7], quantity: pressure}
)");
  for (const int order : {1, 2})
    for (const int ranks : {1, 3}) {
      const Run r = run(text, fmt::format("--set parameters.u=0 --set fields.water.order={}", order), ranks);
      CHECK(r.at_end("low") == Approx(0.6).epsilon(1e-11));
      CHECK(r.at_end("high") == Approx(-0.1).epsilon(1e-10));
      CHECK(std::abs(r.at_end("pressure")) < 1e-10);
      // Of (2y)^2/2 below the plate and of (2 - 3y)^2/2 above, both cubic along it: by Simpson's rule.
      const auto energy = [](double x) {
        const double below = 0.44 + 0.03 * x, above = below + 0.01;
        return (4 * std::pow(below, 3) / 3 + (std::pow(2 - 3 * above, 3) + 1) / 9) / 2;
      };
      CHECK(r.at_end("water.kinetic_energy") ==
            Approx(2.0 / 6 * (energy(0) + 4 * energy(1) + energy(2))).epsilon(1e-10));
    }
  const Run joined = run(text, "--set parameters.u=0 --set fields.water.parts=joined");
  CHECK(std::abs(joined.at_end("high") + 0.1) > 0.01);
}

TEST_CASE("two shear flows beside a plate in space do not mix", "[study]") {
  for (const std::string cell : {"hexahedron", "tetrahedron"})
    for (const int ranks : {1, 2}) {
      const Run r = run(shear_in_space("separate"), "--set meshes.tank.grid.cell=" + cell, ranks);
      CAPTURE(cell, ranks);
      CHECK(r.at_end("low") == Approx(0.6).epsilon(1e-11));
      CHECK(r.at_end("high") == Approx(-0.1).epsilon(1e-10));
      CHECK(std::abs(r.at_end("pressure")) < 1e-10);
    }
  CHECK(std::abs(run(shear_in_space("joined")).at_end("high") + 0.1) > 0.01);
}

TEST_CASE("states follow the parts of the fluid when a plate moves through the mesh", "[study]") {
  for (const auto& [at, rise] :
       {std::pair{0.4, 0.06}, std::pair{0.4, 0.3}, std::pair{0.4, 0.0}, std::pair{0.4 - 0.01, 0.0}})
    for (const std::string cell : {"quadrilateral", "triangle"})
      for (const int order : {1, 2}) {
        const int ranks = rise == 0.06 ? 2 + order % 2 : 1;
        // Upright it moves by a fifth of a cell in a step: its sides come to lie on faces of cells again and
        // again.
        const Run r = run(streams(at, rise),
                          fmt::format("--set meshes.tank.grid.cell={} --set fields.water.order={} "
                                      "--set time.step.initial={}",
                                      cell, order, rise == 0 ? "0.16/3" : "0.05"),
                          ranks);
        CAPTURE(at, rise, cell, order, ranks);
        CHECK(r.at_end("left") == Approx(1.6).epsilon(1e-9));
        CHECK(r.at_end("right") == Approx(-1.4).epsilon(1e-9));
        for (const double force : r.column("force")) CHECK(force < 1e-8);
        CHECK(std::abs(r.at_end("pressure")) < 1e-9);
      }
}

TEST_CASE("a plate that parts cells and moves more than half a cell in a step makes the step shorter") {
  const Run r = run(streams(0.4, 0.06), "--set time.step.initial=0.25");
  CHECK(r.rows.size() > 9);
  CHECK(r.at_end("left") == Approx(1.6).epsilon(1e-9));
}

TEST_CASE("a plate with free edges moves through the mesh in balance, on all numbers of ranks", "[study]") {
  for (const double rise : {0.05, 0.0})
    for (const int order : {1, 2}) {
      const std::string more = fmt::format("--set fields.water.order={}", order);
      const Run r = run(paddle(rise), more);
      REQUIRE(r.rows.size() == 41);
      const auto in = r.column("in"), out = r.column("out");
      for (std::size_t k = 1; k < in.size(); ++k) CHECK(in[k] == Approx(out[k]).epsilon(1e-10));
      CHECK(out.back() > 0.1);  // it does push
      if (order == 2) continue;
      for (const int ranks : {2, 3}) {
        const Run other = run(paddle(rise), more, ranks);
        CHECK(other.at_end("force") == Approx(r.at_end("force")).epsilon(1e-7));
        CHECK(other.at_end("out") == Approx(r.at_end("out")).epsilon(1e-8));
      }
    }
}

TEST_CASE("a run with parts told apart continues to the bit", "[sanitized]") {
  const Folder folder;
  const std::string file = folder.file("scene.yaml", streams(0.4, 0.06));
  const auto seam_run = [&](const std::string& where, const std::string& more) {
    const auto result = seam("run " + file + " --quiet --no-picture --folder " +
                             (folder.path / where).string() + " --set time.end=1 " + more);
    INFO(result.output);
    REQUIRE(result.code == 0);
  };
  seam_run("whole", "");
  seam_run("parts", "--stop-after 9");
  seam_run("parts", "--resume");
  CHECK(folder.read("whole/series.csv") == folder.read("parts/series.csv"));
}

TEST_CASE("fluid that a moving body closes off keeps its state") {
  // Between the cylinder and the walls parts of less than a cell come apart whose nodes all lie elsewhere.
  const Folder folder;
  const auto result = seam("verify " SEAM_SOURCE_DIR
                           "/configs/fsi/c03.yaml --quiet --set fields.water.parts=separate --set "
                           "output.folder=" +
                           (folder.path / "run").string());
  INFO(result.output);
  CHECK(result.code == 0);
}

namespace {

/// Chambers at rest around the middle of the unit square, parted by boxes 0.02 thick that are turned about
/// it.
std::string chambers(const std::vector<double>& turns) {
  std::string interfaces, couplings;
  for (std::size_t k = 0; k < turns.size(); ++k) {
    interfaces += fmt::format(
        "  plate{}: {{type: cut, field: water, body: {{type: box, from: [-1.5, 0.49], to: [2.5, 0.51]}}, "
        "motion: {{rotation: {}, about: [0.5, 0.5]}}}}\n",
        k, turns[k]);
    couplings += fmt::format("  - {{type: fluid_wall, on: plate{}, velocity: [0, 0]}}\n", k);
  }
  return fmt::format(R"(
title: Chambers at rest, parted by thin plates
dimension: 2
plugins: [cutfem_fluid]
meshes:
  tank:
    grid: {{from: [0, 0], to: [1, 1], cells: [10, 10]}}
    boundaries:
      left_low: {{where: "x < 1e-9 && y < 0.5"}}
      left_high: {{where: "x < 1e-9 && y > 0.5"}}
      right_low: {{where: "x > 1 - 1e-9 && y < 0.5"}}
      right_high: {{where: "x > 1 - 1e-9 && y > 0.5"}}
fields:
  water:
    type: cutfem_fluid
    mesh: tank
    parts: separate
    density: 1
    viscosity: 1
    convection: false
    boundary:
      - {{on: [y_min, y_max], velocity: [0, 0]}}
      - {{on: left_low, traction: [1, 0]}}
      - {{on: left_high, traction: [2, 0]}}
      - {{on: right_low, traction: [-3, 0]}}
      - {{on: right_high, traction: [-4, 0]}}
interfaces:
{}coupling:
{}output:
  fields: false
  probes:
    left_low: {{field: water, at: [0.25, 0.25], quantity: pressure}}
    left_high: {{field: water, at: [0.25, 0.75], quantity: pressure}}
    right_low: {{field: water, at: [0.75, 0.25], quantity: pressure}}
    right_high: {{field: water, at: [0.75, 0.75], quantity: pressure}}
)",
                     interfaces, couplings);
}

/// A plate and a disc that overlap in a channel; `side` is -1 for the mirror image.
std::string plate_and_disc(int side) {
  std::string corners;
  std::vector<std::array<double, 2>> places{{0.71, -0.1}, {0.73, -0.1}, {0.83, 0.62}, {0.81, 0.62}};
  if (side < 0) std::reverse(places.begin(), places.end());
  for (const auto& [x, y] : places) corners += fmt::format("{{at: [{}, {}]}}, ", side * x, y);
  return fmt::format(R"(
title: A thin plate and a disc that overlap
dimension: 2
plugins: [cutfem_fluid]
meshes:
  channel: {{grid: {{from: [{}, 0], to: [{}, 1], cells: [20, 10]}}}}
fields:
  water:
    type: cutfem_fluid
    mesh: channel
    parts: separate
    density: 1
    viscosity: 0.05
    convection: false
    boundary:
      - {{on: {}, velocity: ["{}*y*(1-y)*4", 0]}}
      - {{on: [y_min, y_max], velocity: [0, 0]}}
interfaces:
  plate: {{type: cut, field: water, body: {{type: outline, corners: [{}]}}, motion: {{rotation: {}, about: [{}, 0]}}}}
  disc: {{type: cut, field: water, body: {{type: circle, centre: [{}, 0.62], radius: 0.11}}}}
coupling:
  - {{type: fluid_wall, on: plate, velocity: [0, 0]}}
  - {{type: fluid_wall, on: disc, velocity: [0, 0]}}
{}
output:
  fields: false
  probes:
    f: {{interface: plate, quantity: force}}
)",
                     side > 0 ? 0 : -2, side > 0 ? 2 : 0, side > 0 ? "x_min" : "x_max", side, corners,
                     side * 0.03, side * 0.72, side * 0.8, exact_solver);
}

}  // namespace

TEST_CASE("four chambers that meet in a node inside a body have a pressure each") {
  const double quarter = std::acos(0.0);
  const Folder folder;
  const Result run = seam("run " + folder.file("scene.yaml", chambers({0, quarter})) +
                          " --quiet --no-picture --folder " + (folder.path / "results").string());
  INFO(run.output);
  REQUIRE(run.code == 0);
  CHECK_THAT(run.output, !Catch::Contains("share unknowns"));
  const std::string series = folder.read("results/series.csv");
  CHECK(column(series, "left_low").back() == Approx(1).epsilon(1e-9));
  CHECK(column(series, "left_high").back() == Approx(2).epsilon(1e-9));
  CHECK(column(series, "right_low").back() == Approx(3).epsilon(1e-9));
  CHECK(column(series, "right_high").back() == Approx(4).epsilon(1e-9));
}

TEST_CASE("more chambers around a node than it has sets of unknowns are reported once") {
  const double sixth = 2 * std::acos(0.0) / 3;
  const Folder folder;
  const Result run = seam("run " + folder.file("scene.yaml", chambers({0.2, 0.2 + sixth, 0.2 + 2 * sixth})) +
                          " --quiet --no-picture --folder " + (folder.path / "results").string());
  INFO(run.output);
  const std::string said = "bodies part it into more than 4 parts around one node, first near (0.";
  const auto first = run.output.find(said);
  REQUIRE(first != std::string::npos);
  CHECK(run.output.find(said, first + 1) == std::string::npos);
}

TEST_CASE("a plate and a disc that overlap are pushed as their mirror images are") {
  const auto force = [](int side) {
    const Folder folder;
    const Result run = seam("run " + folder.file("scene.yaml", plate_and_disc(side)) +
                            " --quiet --no-picture --folder " + (folder.path / "results").string());
    INFO(run.output);
    REQUIRE(run.code == 0);
    const std::string series = folder.read("results/series.csv");
    return std::pair(column(series, "f.x").back(), column(series, "f.y").back());
  };
  const auto [x, y] = force(1);
  const auto [mirrored_x, mirrored_y] = force(-1);
  CHECK(x > 1);
  CHECK(mirrored_x == Approx(-x).epsilon(1e-10));
  CHECK(mirrored_y == Approx(y).epsilon(1e-10));
}
