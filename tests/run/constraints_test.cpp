// SPDX-License-Identifier: BSD-3-Clause
// Scenes whose unknowns are tied to each other, against the same scenes without.
#include <fmt/format.h>

#include <cmath>

#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

/// The error that a run was checked for.
double error_of(const ShippedRun& run) {
  const std::string summary = run.summary();
  const std::size_t at = summary.find("\"that\": \"velocity.l2\"");
  REQUIRE(at != std::string::npos);
  return std::stod(summary.substr(summary.find_first_of("0123456789", summary.find("value", at))));
}

/// A box of fluid or a block, with constraints.
std::string scene(const std::string& constraints, const std::string& grid = "cells: [4, 4]") {
  return fmt::format(R"yaml(
title: Two blocks
dimension: 2
plugins: [solid]
meshes:
  lower: {{grid: {{from: [0, 0], to: [1, 1], {}}}}}
  upper: {{grid: {{from: [0, 1], to: [1, 2], cells: [4, 4]}}}}
fields:
  lower:
    type: solid
    mesh: lower
    material: {{type: neo_hookean, young: 100, poisson: 0.3}}
    boundary: [{{on: y_min, displacement: [0, 0]}}]
  upper:
    type: solid
    mesh: upper
    material: {{type: neo_hookean, young: 100, poisson: 0.3}}
    boundary: [{{on: y_max, displacement: [0, 0]}}]
constraints: [{}]
)yaml",
                     grid, constraints);
}

void refuses(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& before : {std::string(), std::string("mpirun --oversubscribe -np 2")}) {
    const Run run(text, "--quiet", before);
    CAPTURE(before, run.done.output);
    CHECK(run.done.code != 0);
    for (const std::string& word : words) CHECK_THAT(run.done.output, Catch::Contains(word));
  }
}

}  // namespace

TEST_CASE("a periodic flow is the same half a period away, on all numbers of ranks") {
  const std::string coarse = "--set parameters.n=10 --set parameters.end=0.08 --set 'checks=[]' ";
  const ShippedRun plain("fluid/taylor_green", coarse),
      shifted("fluid/taylor_green", coarse + "--set parameters.shift=0.5");
  for (const std::string c : {".x", ".y"}) {
    CHECK(std::abs(plain("left" + c)) > 0.01);
    CHECK(plain("left" + c) == Approx(shifted("middle" + c)).epsilon(1e-10));
    CHECK(plain("middle" + c) == Approx(shifted("left" + c)).epsilon(1e-10));
    CHECK(plain("left" + c) == Approx(plain("right" + c)).epsilon(1e-12));
  }
  CHECK(plain("water.kinetic_energy") == Approx(shifted("water.kinetic_energy")).epsilon(1e-10));
  for (const int ranks : {2, 3}) {
    const ShippedRun run("fluid/taylor_green", coarse, fmt::format("mpirun --oversubscribe -np {}", ranks));
    for (const char* name : {"left.x", "left.y", "middle.x", "middle.y"})
      CHECK(run(name) == Approx(plain(name)).epsilon(1e-10));
  }
}

TEST_CASE("vortices that drift through a periodic box converge with second order", "[study]") {
  const double coarse = error_of(ShippedRun("fluid/taylor_green", "--set parameters.n=20")),
               fine = error_of(ShippedRun("fluid/taylor_green", "--set parameters.n=40"));
  CAPTURE(coarse, fine);
  CHECK(fine > 0);
  CHECK(coarse > 3.5 * fine);
}

TEST_CASE("parts of a fluid that a periodic boundary joins have one level of the pressure", "[study]") {
  // No flow passes the plug: along x the pressure rises with the force from one side of it to the other one.
  for (const char* ranks : {"", "mpirun --oversubscribe -np 3"}) {
    const Run run(R"yaml(
title: A box that is periodic along x, parted by a plug
dimension: 2
plugins: [cutfem_fluid]
meshes: {box: {grid: {from: [0, 0], to: [1, 1], cells: [12, 12]}}}
fields:
  water:
    type: cutfem_fluid
    mesh: box
    density: 1
    viscosity: 0.1
    body_force: [1, 0]
    boundary: [{on: [y_min, y_max], velocity: [0, 0]}]
interfaces: {plug: {type: cut, field: water, body: {type: box, from: [0.41, -0.2], to: [0.63, 1.2]}}}
coupling: [{type: fluid_wall, on: plug, velocity: [0, 0]}]
constraints: [{type: periodic, field: water, boundaries: [x_min, x_max]}]
time: {theta: 1, end: 0.3, step: {initial: 0.1}}
output:
  fields: false
  probes:
    before: {field: water, at: [0.25, 0.5], quantity: pressure}
    behind: {field: water, at: [0.75, 0.5], quantity: pressure}
)yaml",
                  "--quiet", ranks);
    CAPTURE(run.done.output);
    REQUIRE(run.done.code == 0);
    CHECK(run.series("before").back() - run.series("behind").back() == Approx(0.5).epsilon(1e-6));
  }
}

TEST_CASE("a block between oblique planes of symmetry does as the block along the axes") {
  const std::string loaded = "--set parameters.load=10 --set 'checks=[]' ";
  const ShippedRun straight("solid/turned_block", loaded + "--set parameters.angle=0");
  for (const char* angle : {"pi/6", "-2", "3*pi/4"})
    for (const char* ranks : {"", "mpirun --oversubscribe -np 3"}) {
      const ShippedRun turned("solid/turned_block", loaded + "--set parameters.angle=" + angle, ranks);
      for (const char* name : {"along", "across", "block.strain_energy"}) {
        CHECK(std::abs(straight(name)) > 1e-4);
        CHECK(turned(name) == Approx(straight(name)).epsilon(1e-10));
      }
    }
  ShippedRun("solid/turned_block");
}

TEST_CASE("tied parts do as the whole") {
  const std::string body = R"yaml(
    type: solid
    material: {type: neo_hookean, young: 100, poisson: 0.3}
    density: 1
)yaml";
  const auto written = [&](bool parts) {
    std::string text =
        "title: A block\ndimension: 2\nplugins: [solid]\ntime: {theta: 0.6, end: 0.5, step: {initial: 0.1}}\n"
        "solver: {newton: {tolerance: 1e-11}}\n";
    text += parts ? "meshes:\n  lower: {grid: {from: [0, 0], to: [1, 1], cells: [4, 4]}}\n"
                    "  upper: {grid: {from: [0, 1], to: [1, 2], cells: [4, 4]}}\n"
                  : "meshes:\n  lower: {grid: {from: [0, 0], to: [1, 2], cells: [4, 8]}}\n";
    text += "fields:\n  lower:" + body + "    mesh: lower\n    boundary: [{on: y_min, displacement: [0, 0]}" +
            std::string(parts ? "]\n  upper:" + body + "    mesh: upper\n    boundary: [" : ", ") +
            "{on: y_max, traction: [10*(1 + t), 5]}]\n";
    if (parts) text += "constraints: [{type: tied, fields: [upper, lower], boundaries: [y_min, y_max]}]\n";
    const std::string top = parts ? "upper" : "lower";
    return text + "output:\n  fields: false\n  probes:\n    top: {field: " + top +
           ", at: [1, 2], quantity: displacement}\n    middle: {field: " + top +
           ", at: [0.5, 1], quantity: displacement}\n    force: {field: lower, on: y_min, quantity: "
           "reaction}\n";
  };
  const Run whole(written(false), "--quiet");
  INFO(whole.done.output);
  REQUIRE(whole.done.code == 0);
  for (const char* ranks : {"", "mpirun --oversubscribe -np 2", "mpirun --oversubscribe -np 3"}) {
    const Run parts(written(true), "--quiet", ranks);
    INFO(parts.done.output);
    REQUIRE(parts.done.code == 0);
    for (const char* name : {"top.x", "top.y", "middle.x", "middle.y", "force.x", "force.y"})
      CHECK(parts.series(name).back() == Approx(whole.series(name).back()).epsilon(1e-10));
  }
  ShippedRun("solid/tied_blocks");
}

TEST_CASE("a condition where a field is periodic is warned of") {
  const auto output = [](const std::string& condition, const std::string& unknowns) {
    const Folder folder;
    return seam("check " + folder.file("scene.yaml", R"yaml(title: A flow
dimension: 2
plugins: [cutfem_fluid]
meshes: {box: {grid: {from: [0, 0], to: [1, 1], cells: [4, 4]}}}
fields:
  water:
    type: cutfem_fluid
    mesh: box
    density: 1
    viscosity: 1
    body_force: [1, 0]
    boundary: [{on: [y_min, y_max], velocity: [0, 0]})yaml" +
                                                         condition + R"yaml(]
constraints:
  - {type: periodic, field: water, boundaries: [x_min, x_max])yaml" +
                                                         unknowns + R"yaml(}
time: {theta: 1, end: 1, step: {initial: 0.5}}
output: {fields: false}
)yaml"))
        .output;
  };
  CHECK_THAT(output("", ""), !Catch::Contains("warning"));
  for (const std::string condition : {"velocity: [0, 0]", "outflow: do_nothing", "traction: [1, 0]"}) {
    CAPTURE(condition);
    CHECK_THAT(
        output(", {on: x_max, " + condition + "}", ""),
        Catch::Contains("scene.yaml:12:61: warning: boundary 'x_max' of field 'water' is periodic (") &&
            Catch::Contains("scene.yaml:14:5), and has this condition"));
  }
  CHECK_THAT(output(", {on: x_max, velocity: [0, null]}", ", unknowns: pressure"),
             !Catch::Contains("is periodic"));
}

/// Two patches of fluid on each other, with constraints.
std::string patches(const std::string& more, const std::string& constraint) {
  return fmt::format(R"yaml(
title: Two patches
dimension: 2
plugins: [cutfem_fluid]
meshes:
  lower: {{grid: {{from: [0, 0], to: [1, 0.5], cells: [8, 4]}}}}
  upper: {{grid: {{from: [0, 0.5], to: [1, 1], cells: [8, 4]}}}}
fields:
  lower:
    type: cutfem_fluid
    mesh: lower
    density: 1
    viscosity: 0.1
    boundary: [{{on: [x_min, x_max, y_min], velocity: [0, 0]}}]
    {}
  upper:
    type: cutfem_fluid
    mesh: upper
    density: 1
    viscosity: 0.1
    boundary:
      - {{on: y_max, velocity: ["16*x^2*(1 - x)^2", 0]}}
      - {{on: [x_min, x_max], velocity: [0, 0]}}
constraints:
  - {{type: tied, {}}}
)yaml",
                     more, constraint);
}

TEST_CASE("what is tied has one part a cell") {
  const std::string words = "keeps parts of its cells apart (`parts: separate`)";
  for (const char* tied : {"fields: [upper, lower], boundaries: [y_min, y_max]",
                           "fields: [lower, upper], boundaries: [y_max, y_min]"})
    refuses(patches("parts: separate", tied), {"scene.yaml:25:5", "field 'lower' " + words});
}

namespace {

/// Fluid in a cavity whose lid moves, in one patch or in two that are tied.
std::string cavity(const std::string& meshes, const std::string& lower, const std::string& upper,
                   const std::string& more) {
  const auto field = [&](const char* name, const std::string& boundary) {
    return fmt::format(
        "  {}: {{type: cutfem_fluid, mesh: {}, density: 1, viscosity: 0.1, stabilisation: residual, "
        "boundary: "
        "[{}]}}\n",
        name, name, boundary);
  };
  return "title: A cavity\ndimension: 2\nplugins: [cutfem_fluid]\nmeshes:\n" + meshes + "fields:\n" +
         field("lower", lower) + (upper.empty() ? "" : field("upper", upper)) + more +
         "time: {static: true, end: 1}\nsolver: {newton: {tolerance: 1e-11}}\noutput:\n  fields: false\n"
         "  probes: {p: {field: lower, at: [0.25, 0.25], quantity: pressure}}\n";
}

}  // namespace

TEST_CASE("patches of a fluid that are tied have one level of the pressure") {
  const std::string lid = "{on: y_max, velocity: [\"16*x^2*(1 - x)^2\", 0]}, ",
                    sides = "{on: [x_min, x_max], velocity: [0, 0]}",
                    walls = "{on: [x_min, x_max, y_min], velocity: [0, 0]}",
                    halves =
                        "  lower: {grid: {from: [0, 0], to: [1, 0.5], cells: [8, 4]}}\n"
                        "  upper: {grid: {from: [0, 0.5], to: [1, 1], cells: [8, 4]}}\n";
  const Run whole(cavity("  lower: {grid: {from: [0, 0], to: [1, 1], cells: [8, 8]}}\n", lid + walls, "", ""),
                  "--quiet");
  REQUIRE(whole.done.code == 0);
  const double level = whole.series("p").back();
  CHECK(std::abs(level) > 1e-3);
  const std::string to_lower =
                        "constraints: [{type: tied, fields: [upper, lower], boundaries: [y_min, y_max]}]\n",
                    to_upper =
                        "constraints: [{type: tied, fields: [lower, upper], boundaries: [y_max, y_min]}]\n";
  for (const std::string& ties : {to_lower, to_upper})
    for (const char* solver : {"--quiet", "--quiet --set solver.linear=krylov"})
      for (const char* ranks : {"", "mpirun --oversubscribe -np 3"}) {
        const Run run(cavity(halves, walls, lid + sides, ties), solver, ranks);
        CAPTURE(ties, solver, ranks, run.done.output);
        REQUIRE(run.done.code == 0);
        CHECK(run.series("p").back() == Approx(level).epsilon(1e-8));
      }
  // What enters one patch may leave the other; what leaves neither is lost.
  const std::string in =
      "{on: x_min, velocity: [\"16*y*(0.5 - y)\", 0]}, {on: [x_max, y_min], velocity: [0, 0]}";
  const auto out = [](const std::string& rate) {
    return "{on: x_max, velocity: [\"" + rate +
           "*(y - 0.5)*(1 - y)\", 0]}, {on: [x_min, y_max], velocity: [0, 0]}";
  };
  CHECK(Run(cavity(halves, in, out("16"), to_lower), "--quiet").done.code == 0);
  CHECK_THAT(Run(cavity(halves, in, out("15"), to_lower), "--quiet").done.output,
             Catch::Contains("nothing lets out of a closed part of it what is let in: 0.01953"));
  // The lower one is open beside the upper one.
  const std::string step =
      "  lower: {grid: {from: [0, 0], to: [2, 0.5], cells: [16, 4]}}\n"
      "  upper: {grid: {from: [0, 0.5], to: [1, 1], cells: [8, 4]}}\n";
  for (const std::string& rate : {std::string("16"), std::string("15")})
    CHECK(Run(cavity(step, in, out(rate), to_lower), "--quiet").done.code == 0);
}

TEST_CASE("a body that crosses a periodic boundary is refused, at the start and on its way") {
  const auto channel = [](const std::string& bodies, const std::string& couplings) {
    return fmt::format(R"yaml(
title: A periodic channel with discs
dimension: 2
plugins: [cutfem_fluid]
meshes: {{box: {{grid: {{from: [0, 0], to: [2, 1], cells: [16, 8]}}}}}}
fields:
  water:
    type: cutfem_fluid
    mesh: box
    density: 1
    viscosity: 1
    stabilisation: residual
    boundary: [{{on: [y_min, y_max], velocity: [0, 0]}}]
constraints:
  - {{type: periodic, field: water, boundaries: [x_min, x_max]}}
interfaces: {{{}}}
coupling: [{}]
time: {{end: 0.5, step: {{initial: 0.1}}}}
)yaml",
                       bodies, couplings);
  };
  const auto disc = [](const std::string& name, const std::string& x, const std::string& motion) {
    return name + ": {type: cut, field: water, body: {type: circle, centre: [" + x + ", 0.53], radius: 0.2}" +
           motion + "}";
  };
  const auto wall = [](const std::string& name, const std::string& velocity) {
    return "{type: fluid_wall, on: " + name + ", velocity: [" + velocity + ", 0]}";
  };
  const std::string words = "a body reaches over the periodic boundary 'x_max' of field 'water' at (2, 0.";
  refuses(channel(disc("one", "1.9", ""), wall("one", "0")), {"scene.yaml:15:5", words});
  const std::string moves = ", motion: {translation: [t, 0]}";
  const Run crosses(channel(disc("one", "1.6", moves), wall("one", "1")), "--quiet");
  CAPTURE(crosses.done.output);
  CHECK(crosses.done.code == 1);
  CHECK_THAT(crosses.done.output, Catch::Contains(words) && Catch::Contains("last good state (t = 0.19"));
  // One that stands for the part beyond.
  const Run both(channel(disc("one", "1.9", "") + ", " + disc("two", "-0.1", ""),
                         wall("one", "0") + ", " + wall("two", "0")),
                 "--quiet");
  CAPTURE(both.done.output);
  CHECK(both.done.code == 0);
}

TEST_CASE("parts that are tied to each other and that nothing holds as a whole are found by check") {
  const auto block = [](const std::string& more) {
    return "{type: solid, mesh: lower, material: {type: neo_hookean, young: 100, poisson: 0.3}" + more +
           "}\n";
  };
  const std::string head =
      "title: Parts\ndimension: 2\nplugins: [solid]\nmeshes:\n"
      "  lower: {grid: {from: [0, 0], to: [1, 1], cells: [4, 4]}}\n"
      "  upper: {grid: {from: [0, 1], to: [1, 2], cells: [4, 4]}}\n";
  const std::string
      load = ", boundary: [{on: x_min, traction: [1, 0]}]",
      base = ", boundary: [{on: y_min, displacement: [0, 0]}]",
      upper =
          "  upper: {type: solid, mesh: upper, material: {type: neo_hookean, young: 100, poisson: 0.3}}\n"
          "constraints: [{type: tied, fields: [upper, lower], boundaries: [y_min, y_max]}]\n",
      plate =
          "  plate: {type: rigid_body, mesh: upper}\n"
          "constraints: [{type: rigid, field: lower, body: plate, on: y_max}]\n";
  for (const char* ranks : {"", "mpirun --oversubscribe -np 2"})
    for (const std::string& other : {upper, plate}) {
      const Folder folder;
      const Result loose =
          seam("check " + folder.file("scene.yaml", head + "fields:\n  lower: " + block("") + other), ranks);
      CAPTURE(loose.output);
      CHECK(loose.code == 2);
      CHECK_THAT(loose.output,
                 Catch::Contains("scene.yaml:8:3") &&
                     Catch::Contains(
                         "are tied to each other, and nothing holds them together: "
                         "they can change by a rotation about z, a translation in x, a translation in y") &&
                     Catch::Contains("'lower'"));
      CHECK(Run(head + "fields:\n  lower: " + block(base) + other, "--quiet", ranks).done.code == 0);
    }
}

TEST_CASE("constraints that cannot be are refused, with what does not fit") {
  const std::string periodic = "{type: periodic, field: lower, boundaries: ";
  refuses(scene(periodic + "[x_min]}"), {"found 1 boundaries", "pairs"});
  refuses(scene(periodic + "[x_min, x_min]}"), {"boundary 'x_min' stands here twice"});
  refuses(scene(periodic + "[x_min, y_max]}"), {"on 'x_min' of field 'lower' has none on 'y_max'"});
  refuses(scene(periodic + "[x_min, x_max]}", "cells: [4, 4], map: [x, 'y + 0.1*x*y*(1 - y)']"),
          {"periodic boundaries need meshes that match"});
  refuses(scene(periodic + "[x_min, x_max]}, " + periodic + "[x_min, x_max]}"),
          {"is tied twice", "the other tie stands at"});
  refuses(scene("{type: symmetry, field: lower, boundaries: [y_max]}",
                "cells: [4, 4], map: [x, 'y + 0.1*x*x*y']"),
          {"boundary 'y_max' of mesh 'lower' is not plane", "off one plane"});
  refuses(scene("{type: symmetry, field: lower, boundaries: [roof]}"), {"roof"});
  refuses(scene("{type: tied, fields: [upper, lower], boundaries: [y_min, x_max]}"),
          {"lies on no face of 'x_max' of field 'lower'"});
  // Half a hundredth of a cell apart and in each other is as good as on each other, eight hundredths are not.
  for (const double off : {0.02, -0.02}) {
    const std::string grid = fmt::format("cells: [4, 4], map: [x, 'y + {}*y']", off);
    refuses(scene("{type: tied, fields: [upper, lower], boundaries: [y_min, y_max]}", grid),
            {"scene.yaml:19:15", "lies on no face of 'y_max' of field 'lower'",
             "the tied boundary must lie on the other one"});
    const std::string near = fmt::format("cells: [4, 4], map: [x, 'y + {}*y']", off / 16);
    CHECK(Run(scene("{type: tied, fields: [upper, lower], boundaries: [y_min, y_max]}", near), "--quiet")
              .done.code == 0);
  }
  refuses(scene("{type: tied, fields: [upper], boundaries: [y_min, y_max]}"),
          {"found 1 fields and 2 boundaries"});
  refuses(scene("{type: tied, fields: [upper, lower], boundaries: [y_min, y_max]}, {type: tied, fields: "
                "[lower, upper], "
                "boundaries: [y_max, y_min]}"),
          {"tied to itself in a circle"});
}
