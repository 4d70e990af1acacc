// SPDX-License-Identifier: BSD-3-Clause
// What a scene's `matrix` block asks for: which variants there are, and which mistakes are found before any
// runs.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>

#include "run_command.hpp"

using Catch::Matchers::Contains;
using namespace seam_cli_test;

namespace {

/// A block that is pulled in four steps, and what follows its keys.
std::string pulled(const std::string& matrix,
                   const std::string& time = "{static: true, end: 1, step: {initial: 0.25}}") {
  return "title: Pulled\ndimension: 2\nplugins: [solid]\nparameters: {n: 2, order: 1}\n"
         "meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [n, n]}}}\n"
         "fields:\n  block:\n    type: solid\n    mesh: block\n    order: ${order}\n"
         "    material: {type: neo_hookean, young: 100, poisson: 0.3}\n    boundary:\n"
         "      - {on: x_min, displacement: [0, 0]}\n      - {on: x_max, traction: [0, t]}\n" +
         (time.empty() ? "" : "time: " + time + "\n") +
         "output: {probes: {tip: {field: block, at: [1, 1], quantity: displacement, component: y}}}\n"
         "checks: [{that: tip, is: 0.06, within: 50%, source: order of magnitude}]\nmatrix:\n" +
         matrix;
}

/// The variants that are chosen, without the scene's name.
std::set<std::string> variants(const Folder& folder, const std::string& options = "") {
  const Result result =
      seam("verify --matrix --list " + (folder.path / "scene.yaml").string() + " " + options);
  INFO(result.output);
  CHECK(result.code == 0);
  std::set<std::string> names;
  std::istringstream in(result.output);
  for (std::string line; std::getline(in, line);)
    if (const std::size_t at = line.find("scene.yaml: "); at != std::string::npos)
      CHECK(names.insert(line.substr(at + 12)).second);
  return names;
}

std::set<std::string> variants_of(const std::string& matrix, const std::string& options = "") {
  const Folder folder;
  (void)folder.file("scene.yaml", pulled(matrix));
  return variants(folder, options);
}

}  // namespace

TEST_CASE("a matrix has all combinations but those that are left out") {
  CHECK(variants_of("  vary: {n: [2, 4], solver.linear: [direct, krylov], ranks: [1, 2]}\n") ==
        std::set<std::string>{"n=2 solver.linear=direct ranks=1", "n=2 solver.linear=direct ranks=2",
                              "n=2 solver.linear=krylov ranks=1", "n=2 solver.linear=krylov ranks=2",
                              "n=4 solver.linear=direct ranks=1", "n=4 solver.linear=direct ranks=2",
                              "n=4 solver.linear=krylov ranks=1", "n=4 solver.linear=krylov ranks=2"});
  CHECK(variants_of(
            "  vary: {n: [2, 4], order: [1, 2], solver.linear: [direct, krylov]}\n  together: [n, order]\n"
            "  leave_out: order == 2 && solver.linear == krylov\n") ==
        std::set<std::string>{"n=2 order=1 solver.linear=direct", "n=2 order=1 solver.linear=krylov",
                              "n=4 order=2 solver.linear=direct"});
  // Words and numbers of one key; a parameter that no key changes.
  CHECK(variants_of("  vary: {restart: [none, 1, 2], parameters.n: [2, 3]}\n"
                    "  leave_out: (restart != none && n > 2) || restart == order\n") ==
        std::set<std::string>{"restart=none n=2", "restart=none n=3", "restart=2 n=2"});
  // Values that are expressions of parameters are numbers, and words may hold anything.
  CHECK(variants_of(
            "  vary: {fields.block.density: [order, 2*order, 5]}\n  leave_out: fields.block.density < 3\n") ==
        std::set<std::string>{"fields.block.density=5"});
  CHECK(
      variants_of("  vary: {solver.linear: [direct, '{type: krylov, keep: 2}'], "
                  "fields.block.boundary.0.on: [x_min, '[x_min, y_min]']}\n"
                  "  leave_out: \"solver.linear == {type: krylov, keep: 2} && fields.block.boundary.0.on != "
                  "[x_min, y_min]\"\n")
          .size() == 3);
  CHECK(variants_of("  vary: {n: [1+1, 4]}\n  leave_out: 2*n == 4\n") == std::set<std::string>{"n=4"});
  CHECK(variants_of("  vary: {n: [2, 4]}\n  known: [{when: n == 4, reason: too fine}]\n") ==
        std::set<std::string>{"n=2", "n=4  (known: too fine)"});
}

TEST_CASE("few variants hold all pairs of values, and all that must agree") {
  const std::string keys =
      "  vary: {n: [2, 3, 4], order: [1, 2], solver.linear: [direct, krylov], fields.block.material.poisson: "
      "[0.2, 0.3, 0.4]}\n"
      "  combine: pairs\n";
  const auto pairs = [](const std::set<std::string>& names) {
    std::set<std::string> all;
    for (const std::string& name : names) {
      std::istringstream in(name);
      const std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
      for (std::size_t i = 0; i < words.size(); ++i)
        for (std::size_t j = i + 1; j < words.size(); ++j) all.insert(words[i] + " " + words[j]);
    }
    return all;
  };
  const std::set<std::string> few = variants_of(keys);
  CHECK(few.size() >= 9);  // no fewer can hold the pairs of the two keys with three values
  CHECK(few.size() <= 12);
  CHECK(pairs(few).size() == 3 * 2 + 3 * 2 + 3 * 3 + 2 * 2 + 2 * 3 + 2 * 3);
  // Pairs that are left out are not looked for.
  const std::set<std::string> fewer = variants_of(keys + "  leave_out: n == 4 && order == 2\n");
  CHECK(pairs(fewer).size() == pairs(few).size() - 1);
  CHECK(std::ranges::none_of(fewer, [](const std::string& name) { return name.starts_with("n=4 order=2"); }));
  // Keys that change together are one, for agreements too.
  CHECK(variants_of("  vary: {n: [2, 4], order: [1, 2], ranks: [1, 2]}\n  together: [n, order]\n  agree: "
                    "[{over: [n], within: 1}]\n")
            .size() == 4);
  // What must agree is there with all values of its keys.
  const std::set<std::string> whole = variants_of(
      "  vary: {n: [2, 3, 4], order: [1, 2], solver.linear: [direct, krylov], ranks: [1, 2, 3]}\n  combine: "
      "pairs\n"
      "  agree: [{over: [ranks], within: 1e-9}]\n");
  CHECK(whole.size() % 3 == 0);
  CHECK(whole.size() < 36);
  for (const std::string& name : whole)
    for (const std::string ranks : {"1", "2", "3"})
      CHECK(whole.contains(name.substr(0, name.size() - 1) + ranks));
}

TEST_CASE("shards are the whole together, and keep together what must agree") {
  const Folder folder;
  (void)folder.file("scene.yaml", pulled("  vary: {n: [2, 3, 4, 5, 6], order: [1, 2], ranks: [1, 2]}\n"
                                         "  agree: [{over: [ranks], within: 1e-9}]\n"));
  const std::set<std::string> whole = variants(folder);
  REQUIRE(whole.size() == 20);
  for (const int parts : {1, 3, 5, 25}) {
    std::set<std::string> together;
    for (int part = 1; part <= parts; ++part) {
      const std::set<std::string> own = variants(folder, fmt::format("--shard {}/{}", part, parts));
      CHECK(own.size() <= 2U * ((10 + parts - 1) / parts));
      for (const std::string& name : own) {
        CHECK(together.insert(name).second);
        CHECK(own.contains(name.substr(0, name.size() - 1) + (name.back() == '1' ? "2" : "1")));
      }
    }
    CHECK(together == whole);
  }
  CHECK(variants(folder, "--filter 'n=5 order=2'").size() == 2);
  CHECK(variants(folder, "--filter 'order=1*ranks=2'").size() == 5);
  CHECK(variants(folder, "--filter scene.yaml").size() == 20);
  (void)folder.file("scene.yaml",
                    pulled("  vary: {meshes.block.grid.cells: ['[2, 2]', '[4, 2]'], order: [1, 2]}\n"));
  CHECK(variants(folder, "--filter 'cells=[4, 2]*order=2'") ==
        std::set<std::string>{"meshes.block.grid.cells=[4, 2] order=2"});
  for (const std::string wrong : {"0/3", "4/3", "3", "a/b", "1/", "-1/2", "1/2/3"}) {
    const Result result =
        seam("verify --matrix --list " + (folder.path / "scene.yaml").string() + " --shard " + wrong);
    CHECK(result.code == 2);
    CHECK_THAT(result.output, Contains("expected a part of all, as 2/5"));
  }
}

TEST_CASE("a mistake in a matrix is found by seam check with its place") {
  const std::string keys = "  vary: {n: [2, 4], solver.linear: [direct, krylov]}\n";
  struct Mistake {
    std::string matrix;
    std::string told;
    int line;
    std::string time = "{static: true, end: 1, step: {initial: 0.25}}";
  };
  const std::vector<Mistake> mistakes{
      {"  vary: {m: [2]}\n", "the scene has no parameter 'm'. It has: n, order", 19},
      {"  vary: {n: [2], solver.liner: [direct]}\n", "unknown key 'liner'", 19},
      {"  vary:\n    n: [2]\n    fields.block.material.poisson: [0.3, much]\n",
       "the scene cannot be read with 'much'", 21},
      {"  vary: {solver.linear: [direct, krilov]}\n", "the scene cannot be read with 'krilov'", 19},
      {"  vary: {n: []}\n", "no values", 19},
      {"  vary: {}\n", "expected at least one key with its values", 19},
      {"  vary: {ranks: [1, 0]}\n", "found '0', expected a number of ranks from 1", 19},
      {"  vary: {restart: [never]}\n", "or `none` for a run in one piece", 19},
      {"  vary: {restart: [none, 1]}\n", "the scene takes a single step", 18, ""},
      {"  vary: {restart: [none, 1]}\n", "the scene takes a single step", 19,
       "{static: true, end: 1, step: {initial: 1}}"},
      {keys + "  leave_out: n > 0\n", "leaves out all variants", 19},
      {keys + "  leave_out: solver.linear == kryloff\n",
       "'kryloff' is no key of `vary`, no word that one takes, and no parameter. Did you mean 'krylov'?", 20},
      {keys + "  leave_out: n == 3\n", "matrix.leave_out: no variant is such", 20},
      {"  vary: {n: [2, 4, 2]}\n", "a value stands there twice: there are two variants 'n=2'", 19},
      {"  vary: {n: [2], parameters.n: [4]}\n", "the key stands there twice, also as 'n'", 19},
      {keys + "  known: [{when: n == 2, reason: ''}]\n", "say why these variants fall short", 20},
      {keys + "  known: [{when: n == 3, reason: none}]\n", "no variant is such", 20},
      {keys + "  agree: [{over: [ranks], within: 1e-9}]\n",
       "matrix.agree.over: 'ranks' is no key of `vary`. Known: n, solver.linear", 20},
      {"  vary: {n: [2], ranks: [1, 2]}\n  leave_out: ranks > 1\n  agree: [{over: [ranks], within: 1e-9}]\n",
       "no two variants differ in ranks alone", 21},
      {keys + "  together: [n, ranks]\n", "matrix.together: 'ranks' is no key of `vary`", 20},
      {keys + "  combine: some\n", "expected", 20},
  };
  for (const Mistake& mistake : mistakes) {
    INFO(mistake.matrix);
    const Folder folder;
    const std::string scene = folder.file("scene.yaml", pulled(mistake.matrix, mistake.time));
    const Result result = seam("check --without-meshes " + scene);
    INFO(result.output);
    CHECK(result.code == 2);
    CHECK_THAT(result.output, Contains(mistake.told));
    CHECK_THAT(result.output, Contains(fmt::format("scene.yaml:{}", mistake.line)));
  }
  const Folder folder;
  CHECK(seam("check " + folder.file("scene.yaml", pulled(keys))).code == 0);
}

TEST_CASE("coverage lists types, choices and pairs of coupling and field that no variant uses") {
  const Folder folder;
  const std::string scene = folder.file(
      "scene.yaml",
      pulled("  vary: {meshes.block.grid.cell: [quadrilateral, triangle], solver.linear: [direct]}\n"));
  const Result listed = seam("verify --matrix --list --coverage " + scene);
  INFO(listed.output);
  CHECK(listed.code == 0);
  CHECK_THAT(listed.output, Contains("| hyperelastic:saint_venant_kirchhoff | solid |") &&
                                Contains("| linear_solver:krylov | core |"));
  CHECK_THAT(listed.output,
             !Contains("| hyperelastic:neo_hookean | solid |") && !Contains("| field:solid | solid |"));
  // Both cells are there; of the diagonals of triangles, which have a default, one.
  CHECK_THAT(listed.output, Contains("| scene.meshes.grid.cell | hexahedron, tetrahedron |") &&
                                Contains("| scene.meshes.grid.diagonals | "));
  // A key of a type that nobody uses is not told apart from it.
  CHECK_THAT(listed.output, !Contains("| constraint:joint.kind |"));

  const std::string both =
      folder.file("pressed.yaml",
                  "title: Pressed\ndimension: 2\nplugins: [solid, nitsche_fsci]\nmeshes: {block: {grid: "
                  "{from: [0, 0], to: [1, 1], cells: [2, 2]}}}\n"
                  "fields: {block: {type: solid, mesh: block, material: {type: neo_hookean, young: 100, "
                  "poisson: 0.3}, boundary: [{on: y_max, displacement: [0, -0.1]}]}}\n"
                  "interfaces: {floor: {type: obstacle, from: block, boundaries: [y_min], body: {type: box, "
                  "from: [-1, -1], to: [2, 0]}}}\n"
                  "coupling: [{type: contact, on: floor}]\n");
  CHECK_THAT(seam("verify --matrix --list --coverage " + both).output, Contains("| contact | solid | "));

  const Result covered = seam("verify --matrix --list --cover nitsche_fsci " + both);
  INFO(covered.output);
  CHECK(covered.code == 1);
  CHECK_THAT(covered.output, Contains("coupling:fsi: no variant uses it") && !Contains("coupling:contact:"));
  const Result unknown = seam("verify --matrix --list --cover nitsche " + both);
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.output, Contains("no scene loads such a plugin. Loaded: core, nitsche_fsci, solid"));
}

TEST_CASE("series that agree are looked up by seam check, a vector by its name") {
  const Folder folder;
  const auto check = [&](const std::string& series) {
    return seam("check " + folder.file("scene.yaml",
                                       pulled("  vary: {ranks: [1, 2]}\n  agree: [{over: [ranks], series: [" +
                                              series + "], within: 1e-9}]\n")));
  };
  CHECK(check("tip").code == 0);
  const Result unknown = check("top");
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.output,
             Contains("scene.yaml:20") && Contains("the run records no series 'top'. Did you mean 'tip'?"));
  (void)folder.file("scene.yaml", pulled(""));
}

TEST_CASE("folders hold scenes of a tier, none that is hidden, and each once") {
  const Folder folder;
  const auto names = [&](const std::string& arguments) {
    const Result result = seam("verify --matrix --list " + arguments);
    std::set<std::string> all;
    std::istringstream in(result.output);
    for (std::string line; std::getline(in, line);)
      if (const std::size_t at = line.find(".yaml: ");
          at != std::string::npos && line.ends_with("as it stands"))
        CHECK(all.insert(std::filesystem::path(line.substr(0, at)).filename()).second);
    return all;
  };
  const std::string plain = pulled("").substr(0, pulled("").find("matrix:")),
                    nightly = "tier: nightly\n" + plain;
  std::filesystem::create_directories(folder.path / ".hidden");
  const std::string fast_scene = folder.file("fast.yaml", plain),
                    nightly_scene = folder.file("nightly.yaml", nightly);
  for (const std::string name : {".own.yaml", ".hidden/a.yaml", "workflow.yml", "note.txt"})
    (void)folder.file(name, plain);
  const std::string all = folder.path.string();
  CHECK(names(all) == std::set<std::string>{"fast"});
  CHECK(names(all + " --tier nightly") == std::set<std::string>{"nightly"});
  CHECK(names(all + " --tier all " + fast_scene) == std::set<std::string>{"fast", "nightly"});
  // What is named is run, whatever its tier.
  CHECK(names(nightly_scene) == std::set<std::string>{"nightly"});
  // What cannot be read has no tier: it is told in each.
  (void)folder.file("broken.yaml", nightly + "wrong: 1\n");
  for (const std::string tier : {"fast", "nightly"}) {
    const Result broken = seam("verify --matrix --list --tier " + tier + " " + all);
    CHECK(broken.code == 1);
    CHECK_THAT(broken.output, Contains("unknown key 'wrong'"));
  }
}
