// SPDX-License-Identifier: BSD-3-Clause
// Ties and contact with unknowns on surfaces.
#include <fmt/format.h>

#include <cmath>

#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

/// Two blocks between walls, pressed together. @param cells of the upper one, of the lower one, along the
/// seam
std::string blocks(int upper, int lower, const std::string& rest) {
  return R"scene(
title: Two blocks between walls
dimension: 2
plugins: [solid, mortar_contact]
parameters: {order: 1}
meshes:
  lower: {grid: {from: [0, 0], to: [1, 0.5], cells: [)scene" +
         std::to_string(lower) + R"scene(, 2], order: "${order}"}}
  upper: {grid: {from: [0, 0.5], to: [1, 1], cells: [)scene" +
         std::to_string(upper) + R"scene(, 3], order: "${order}"}}
fields:
  lower:
    type: solid
    mesh: lower
    order: "${order}"
    material: {type: neo_hookean, young: 10, poisson: 0.3}
    boundary:
      - {on: y_min, displacement: [null, 0]}
      - {on: [x_min, x_max], displacement: [0, null]}
  upper:
    type: solid
    mesh: upper
    order: "${order}"
    material: {type: neo_hookean, young: 10, poisson: 0.3}
    boundary:
      - {on: y_max, displacement: [null, "-0.2*t"]}
      - {on: [x_min, x_max], displacement: [0, null]}
solver: {newton: {tolerance: 1e-12, increment_tolerance: 1e-12}}
)scene" + rest;
}

const std::string tie = R"scene(
interfaces:
  seam: {type: non_matching, fields: [upper, lower], boundaries: [y_min, y_max]}
coupling:
  - {type: mortar_tie, on: seam}
output:
  fields: false
  probes:
    top: {field: upper, on: y_max, quantity: reaction, component: y}
    wall: {field: upper, at: [0, 0.5], quantity: seam.traction, component: y}
    middle: {field: upper, at: [0.45, 0.5], quantity: seam.traction, component: y}
)scene";

const std::string contact = R"scene(
interfaces:
  seam: {type: contact, from: upper, to: lower, boundaries: [y_min], opposite: [y_max]}
coupling:
  - {type: mortar_contact, on: seam}
output:
  fields: false
  probes:
    top: {field: upper, on: y_max, quantity: reaction, component: y}
    wall: {field: upper, at: [0, 0.5], quantity: seam.pressure}
    middle: {field: upper, at: [0.45, 0.5], quantity: seam.pressure}
)scene";

/// Pressed by this, they press on each other alike everywhere.
double uniform_push(const Run& run) {
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  const double push = -run.series("top").back();
  CHECK(push > 1);
  CHECK(run.series("middle").back() == Approx(push).epsilon(1e-11));
  CHECK(run.series("wall").back() == Approx(push).epsilon(1e-11));
  return push;
}

}  // namespace

TEST_CASE("blocks between walls are tied where nodes match and where they do not") {
  // What the walls give already is left to them: where nodes match, a multiplier for it would find nothing to
  // hold.
  const auto [upper, lower] = GENERATE(std::pair(4, 4), std::pair(5, 3), std::pair(3, 5));
  const int order = GENERATE(1, 2);
  CAPTURE(upper, lower, order);
  const Run run(blocks(upper, lower, tie), "--set parameters.order=" + std::to_string(order));
  const double push = uniform_push(run);
  CHECK(run.series("seam.apart").back() < 1e-14);
  CHECK(run.series("seam.force.y").back() == Approx(push).epsilon(1e-11));
}

TEST_CASE("blocks between planes of symmetry are tied as between walls") {
  std::string text = blocks(4, 4, tie);
  const std::string wall = "      - {on: [x_min, x_max], displacement: [0, null]}\n";
  for (std::size_t at = text.find(wall); at != std::string::npos; at = text.find(wall))
    text.erase(at, wall.size());
  text += R"scene(
constraints:
  - {type: symmetry, field: lower, boundaries: [x_min, x_max]}
  - {type: symmetry, field: upper, boundaries: [x_min, x_max]}
)scene";
  uniform_push(Run(text));
}

TEST_CASE("a pressure between blocks is uniform, of the first order and of the second") {
  const int order = GENERATE(1, 2);
  CAPTURE(order);
  const Run run(blocks(5, 3, contact), "--set parameters.order=" + std::to_string(order));
  const double push = uniform_push(run);
  CHECK(run.series("seam.area").back() == Approx(1));
  CHECK(std::abs(run.series("seam.gap").back()) < 1e-13);
  CHECK(run.series("seam.force.y").back() == Approx(push).epsilon(1e-11));
}

TEST_CASE("blocks that are pulled apart part, and nothing acts between them") {
  std::string text = blocks(5, 3, contact);
  const std::string pressed = "-0.2*t";
  text.replace(text.find(pressed), pressed.size(), "0.2*t");
  const Run run(text);
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(std::abs(run.series("top").back()) < 1e-12);
  CHECK(std::abs(run.series("seam.pressure").back()) < 1e-12);
  CHECK(run.series("seam.area").back() == 0);
  CHECK(run.series("seam.gap").back() == Approx(0.2));
}

TEST_CASE("a body that touches itself is sent to Nitsche's contact") {
  std::string text = blocks(5, 3, contact);
  const std::string to = "to: lower, boundaries: [y_min], opposite: [y_max]";
  text.replace(text.find(to), to.size(), "to: upper, boundaries: [y_min], opposite: [y_max]");
  const Run run(text);
  CHECK(run.done.code == 2);
  CHECK_THAT(run.done.output, Catch::Contains("field 'upper' touches itself there"));
  CHECK_THAT(run.done.output, Catch::Contains("use the coupling `contact`"));
}

TEST_CASE("boundaries that do not lie on each other are not tied in silence") {
  std::string text = blocks(5, 3, tie);
  const std::string right = "boundaries: [y_min, y_max]";
  text.replace(text.find(right), right.size(), "boundaries: [y_max, y_min]");
  const Run run(text);
  CAPTURE(run.done.output);
  CHECK(run.done.code == 2);
  CHECK_THAT(run.done.output, Catch::Contains("do not lie on each other"));
}

TEST_CASE("a block that touches another one exactly is held by it under a dead load") {
  std::string text = blocks(5, 3, contact);
  const std::string given = "{on: y_max, displacement: [null, \"-0.2*t\"]}";
  text.replace(text.find(given), given.size(), "{on: y_max, traction: [0, -2]}");
  const Run run(text);
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(run.series("middle").back() == Approx(2).epsilon(1e-11));
}

TEST_CASE("a surface of the second order that is partly covered finds where it touches") {
  const std::string text = blocks(5, 3, R"scene(
interfaces:
  lid:
    type: obstacle
    from: upper
    boundaries: [y_max]
    reach: 0.3
    body: {type: outline, corners: [{at: [0.73, 1.02]}, {at: [1.4, 1]}, {at: [1.4, 1.4]}, {at: [0.73, 1.4]}]}
    motion: {translation: [0, "-0.1*t"]}
  seam: {type: non_matching, fields: [upper, lower], boundaries: [y_min, y_max]}
coupling:
  - {type: mortar_contact, on: lid}
  - {type: mortar_tie, on: seam}
time: {static: true, end: 1, step: {initial: 0.25}}
output: {fields: false}
)scene");
  std::string free = text;
  const std::string given = "      - {on: y_max, displacement: [null, \"-0.2*t\"]}\n";
  free.erase(free.find(given), given.size());
  const Run run(free, "--set parameters.order=2");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(run.series("lid.force.y").back() < -0.1);
  CHECK(run.series("time").size() == 5);
}

TEST_CASE("a tie of which nothing is left on a face is refused") {
  // All nodes of the slave's face have a given displacement, and what is opposite is free.
  std::string text = blocks(5, 3, tie);
  const std::string given = "{on: y_max, displacement: [null, \"-0.2*t\"]}";
  text.replace(text.find(given), given.size(), "{on: [y_min, y_max], displacement: [null, \"-0.2*t\"]}");
  for (const std::string ranks : {"", "2"}) {
    const Run run(text, "", ranks.empty() ? "" : "mpirun --oversubscribe -np 2");
    CHECK(run.done.code == 2);
    CHECK_THAT(run.done.output,
               Catch::Contains("nothing is left of 'seam.traction' on the face of field 'upper'"));
    CHECK_THAT(run.done.output, Catch::Contains("Let the other field come first"));
  }
}

TEST_CASE("a tie across the end of what is opposite is held by nodes that see enough of it") {
  // The lower block ends a little beyond a node of the upper one, whose next node it hardly reaches.
  const int order = GENERATE(1, 2);
  const auto corner = [&](double beyond) {
    std::string text = blocks(4, 3, tie);
    const std::string walls = "      - {on: [x_min, x_max], displacement: [0, null]}\n",
                      lower = "to: [1, 0.5]", given = "{on: y_max, displacement: [null, \"-0.2*t\"]}";
    for (std::size_t at = text.find(walls); at != std::string::npos; at = text.find(walls))
      text.replace(at, walls.size(), "      - {on: x_min, displacement: [0, null]}\n");
    text.replace(text.find(lower), lower.size(), "to: [" + std::to_string(0.5 + beyond) + ", 0.5]");
    text.replace(text.find(given), given.size(), "{on: y_max, traction: [0, -0.5]}");
    text +=
        "    corner: {field: upper, at: [1, 1], quantity: displacement, component: y}\n"
        "    beyond: {field: upper, at: [0.75, 0.5], quantity: seam.traction, component: y}\n";
    const std::string reaction = "    top: {field: upper, on: y_max, quantity: reaction, component: y}\n";
    text.erase(text.find(reaction), reaction.size());
    const Run run(text, "--set parameters.order=" + std::to_string(order));
    CAPTURE(order, beyond, run.done.output);
    REQUIRE(run.done.code == 0);
    CHECK(std::abs(run.series("beyond").back()) < 5);
    CHECK_THAT(run.done.output, Catch::Contains("none of the second opposite: it is free there"));
    return run.series("corner").back();
  };
  const double ends_there = corner(0);
  CHECK(corner(1e-6) == Approx(ends_there).epsilon(1e-5));
  CHECK(corner(1e-4) == Approx(ends_there).epsilon(1e-3));
  CHECK(corner(0.05) == Approx(ends_there).epsilon(0.2));
}

TEST_CASE("surfaces that lie apart or in each other are spoken of") {
  const auto lifted = [](const std::string& rest, const std::string& way) {
    std::string text = blocks(5, 3, rest.substr(0, rest.find("output:")));  // probes would stay behind
    const std::string from = "from: [0, 0.5], to: [1, 1]";
    return text.replace(text.find(from), from.size(), "from: [0, 0.5 + " + way + "], to: [1, 1]");
  };
  CHECK_THAT(Run(lifted(tie, "0.06")).done.output, Catch::Contains("lie up to 0.06 m apart"));
  CHECK_THAT(Run(lifted(tie, "1e-9")).done.output, !Catch::Contains("apart"));
  CHECK_THAT(Run(lifted(contact, "(-0.3)")).done.output,
             Catch::Contains("seem to overlap by 0.3 m at the start, more than the `depth`"));
  CHECK_THAT(Run(blocks(3, 3, contact + R"scene(
constraints:
  - {type: tied, fields: [lower, upper], boundaries: [y_max, y_min]}
)scene"))
                 .done.output,
             Catch::Contains("are tied to each other on 'y_max' and 'y_min' by a constraint"));
}

TEST_CASE("a block that two obstacles close in on is there in a few iterations") {
  const Run run(R"scene(
title: A block in a box
dimension: 2
plugins: [solid, mortar_contact]
meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [4, 4]}}}
fields:
  block:
    type: solid
    mesh: block
    material: {type: neo_hookean, young: 10, poisson: 0.3}
    boundary:
      - {on: x_min, displacement: [0, null]}
      - {on: y_max, displacement: [null, "-0.1*t"]}
interfaces:
  floor: {type: obstacle, from: block, boundaries: [y_min], body: {type: box, from: [-5, -2], to: [5, 0]}}
  wall: {type: obstacle, from: block, boundaries: [x_max], body: {type: box, from: [1, -3], to: [4, 5]}, motion: {translation: ["-0.05*t", 0]}}
coupling:
  - {type: mortar_contact, on: floor}
  - {type: mortar_contact, on: wall}
time: {static: true, end: 1, step: {initial: 0.25}}
solver: {newton: {tolerance: 1e-11, increment_tolerance: 1e-10}}
output:
  fields: false
  errors: {u: {field: block, unknown: displacement, exact: [-0.05*x, -0.1*y]}}
checks:
  - {that: u.l2, kind: exact, is: 0, within: 1e-12, source: uniform strain}
  - {that: newton.iterations.most, kind: exact, at_most: 7, source: an increment is not shortened again and again}
  - {that: steps.rejected, kind: exact, is: 0, within: 0, source: the same}
)scene");
  CAPTURE(run.done.output);
  CHECK(run.done.code == 0);
}

TEST_CASE("bodies in the mixed form touch each other") {
  std::string text = blocks(5, 3, contact);
  const std::string material =
      "order: \"${order}\"\n    material: {type: neo_hookean, young: 10, poisson: 0.3}";
  for (std::size_t at = text.find(material); at != std::string::npos; at = text.find(material))
    text.replace(at, material.size(),
                 "order: \"${order}\"\n    formulation: mixed\n    material: {type: neo_hookean, young: 10, "
                 "poisson: 0.49}");
  uniform_push(Run(text, "--set parameters.order=2"));
}

TEST_CASE("impacts by the trapezoidal rule are warned of, and lose energy by the two-step scheme") {
  const std::string scene = R"scene(
title: A block falls on a floor
dimension: 2
plugins: [solid, mortar_contact]
meshes: {block: {grid: {from: [0, 0], to: [1, 0.5], cells: [4, 2]}}}
fields:
  block:
    type: solid
    mesh: block
    density: 1
    material: {type: neo_hookean, young: 50, poisson: 0.3}
    body_force: [0, -1]
    initial: {displacement: [0, 0.1]}
interfaces: {floor: {type: obstacle, from: block, boundaries: [y_min], body: {type: box, from: [-2, -1], to: [3, 0]}}}
coupling: [{type: mortar_contact, on: floor}]
time: {scheme: bdf2, end: 3, step: {initial: 0.01}}
output:
  fields: false
  probes: {middle: {field: block, at: [0.5, 0.25], quantity: displacement, component: y}}
  formulas: {energy: block_strain_energy + block_kinetic_energy + 0.5*middle}
)scene";
  const std::string warning = "each impact may add energy";
  const Run run(scene);
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK_THAT(run.done.output, !Catch::Contains(warning));
  const std::vector<double> energy = run.series("energy");
  CHECK(*std::ranges::max_element(energy) < 0.05 * (1 + 1e-3));
  std::string trapezoidal = scene;
  const std::string scheme = "scheme: bdf2, end: 3";
  trapezoidal.replace(trapezoidal.find(scheme), scheme.size(), "theta: 0.5, end: 0.05");
  CHECK_THAT(Run(trapezoidal).done.output, Catch::Contains(warning));
}

TEST_CASE("a block whose top is held slides down between walls that it touches from the start") {
  const int cells = GENERATE(1, 3);
  CAPTURE(cells);
  const Run run(R"scene(
title: A block in a channel
dimension: 2
plugins: [solid, mortar_contact]
parameters: {n: )scene" +
                std::to_string(cells) + R"scene(}
meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [n, 4]}}}
fields:
  block:
    type: solid
    mesh: block
    material: {type: neo_hookean, young: 10, poisson: 0.3}
    boundary: [{on: y_max, displacement: [0, "-0.1*t"]}]
interfaces:
  floor: {type: obstacle, from: block, boundaries: [y_min], body: {type: box, from: [-5, -2], to: [5, 0]}}
  left: {type: obstacle, from: block, boundaries: [x_min], body: {type: box, from: [-4, -3], to: [0, 5]}}
  right: {type: obstacle, from: block, boundaries: [x_max], body: {type: box, from: [1, -3], to: [4, 5]}}
coupling:
  - {type: mortar_contact, on: floor}
  - {type: mortar_contact, on: left}
  - {type: mortar_contact, on: right}
solver: {newton: {tolerance: 1e-11, increment_tolerance: 1e-10}}
output:
  fields: false
  errors: {u: {field: block, unknown: displacement, exact: [0, -0.1*y]}}
checks: [{that: u.l2, kind: exact, is: 0, within: 1e-12, source: uniform strain}]
)scene");
  CAPTURE(run.done.output);
  CHECK(run.done.code == 0);
}

TEST_CASE("edges of a punch slide over a body's nodes") {
  const double offset = GENERATE(0.0, 1e-12, 1e-4, 0.02);
  const int order = GENERATE(1, 2);
  CAPTURE(offset, order);
  const Run run(R"scene(
title: A punch pressed into a slab and drawn along it
dimension: 2
plugins: [solid, mortar_contact]
parameters: {o: )scene" +
                std::to_string(order) + ", left: " + fmt::format("{}", 0.25 + offset / 16) + R"scene(}
meshes: {slab: {grid: {from: [0, 0], to: [1, 1], cells: [16, 16], order: "${o}"}}}
fields:
  slab:
    type: solid
    mesh: slab
    order: "${o}"
    material: {type: neo_hookean, young: 10, poisson: 0.3}
    boundary: [{on: y_min, displacement: [0, 0]}]
interfaces:
  tool:
    type: obstacle
    from: slab
    boundaries: [y_max]
    body: {type: box, from: [left, 1], to: [left + 0.3, 2]}
    motion: {translation: ["0.2*max(0, t - 1)", "-0.05*min(t, 1)"]}
coupling: [{type: mortar_contact, on: tool}]
time: {static: true, end: 2, step: {initial: 0.1}}
solver: {newton: {tolerance: 1e-10, increment_tolerance: 1e-8}}
output:
  fields: false
  probes: {bottom: {field: slab, on: y_min, quantity: reaction, component: y}}
  formulas: {unbalanced: abs(bottom + tool_force_y)}
  statistics: {most_unbalanced: {of: unbalanced, what: maximum}}
checks:
  - {that: steps.rejected, kind: trend, at_most: 0, source: "what an edge presses on changes hands gradually"}
  - {that: newton.iterations.most, kind: trend, at_most: 12, source: the tangent is exact}
  - {that: most_unbalanced, kind: exact, at_most: 1e-10, source: balance of forces}
  - {that: bottom, kind: reference, at: 1, is: 0.366, within: 3%, source: "contact by Nitsche's method on 64 cells"}
)scene");
  CAPTURE(run.done.output);
  CHECK(run.done.code == 0);
}
