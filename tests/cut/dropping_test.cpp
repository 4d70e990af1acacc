// SPDX-License-Identifier: BSD-3-Clause
// Parts of a field too small to be kept, through the cuts of one step.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "cut/cut_test.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/cut/field_cut.hpp"
#include "seam/cut/interface_motion.hpp"
#include "seam/state/state_store.hpp"

using namespace seam;

namespace {

/// A chamber with thick walls.
std::vector<Surface> chamber(double x0, double x1, double y0, double y1) {
  const auto rectangle = [](double a, double b, double c, double d) {
    return polygon({{a, b, 0}, {c, b, 0}, {c, d, 0}, {a, d, 0}});
  };
  return {rectangle(x0 - .2, y0 - .2, x1 + .2, y0), rectangle(x0 - .2, y1, x1 + .2, y1 + .2),
          rectangle(x0 - .2, y0 - .2, x0, y1 + .2), rectangle(x1, y0 - .2, x1 + .2, y1 + .2)};
}

/// A field in the unit square, cut by bodies; all its nodes have a state.
struct Pond {
  explicit Pond(int cells)
      : mesh(grid(CellType::quadrilateral, {cells, cells, 0}, unmoved())),
        field("water", mesh, {{"u", 1, 1, 1, ""}}),
        cut(field) {
    for (Block& block : field.blocks()) block.known.assign(block.known.size(), 1);
  }
  Mesh mesh;
  Field field;
  FieldCut cut;
};

}  // namespace

TEST_CASE("What the first cut of a step drops stays out for the step", "[cut][parts][ranks]") {
  const double h = 1.0 / 20;
  Pond pond(20);
  FieldCut& cut = pond.cut;
  double shift = 0, width = h, slit = 0;
  for (int k = 0; k < 4; ++k)
    cut.add_body([&, k](double) {
      const double lower = .52 + (k == 3 && slit > 0 ? .2 + slit : 0);
      return chamber(.43 + shift, .43 + shift + width, lower, .52 + h)[k];
    });

  CHECK(cut.update(0));
  CHECK(cut.dropped_volume() == Approx(h * h).epsilon(1e-12));
  CHECK_FALSE(cut.update(0));
  // Into cells that were body.
  shift = 0.04;
  CHECK(cut.update(0));
  CHECK(cut.dropped_volume() == Approx(h * h).epsilon(1e-12));
  // Beyond the size that a new step would keep.
  width = 2.5 * h;
  CHECK(cut.update(0));
  CHECK(cut.dropped_volume() == Approx(2.5 * h * h).epsilon(1e-12));
  CHECK(cut.mesh().find_parts().volume.size() == 1);
  // A new step decides anew, and finds no states to start from.
  CHECK(cut.update(0.1));
  CHECK(cut.dropped_volume() == Approx(2.5 * h * h).epsilon(1e-12));
  // Through a slit beneath a wall it is filled from outside, a layer of cells a step.
  slit = 0.6 * h;
  double before = 1;
  for (int step = 2; cut.dropped_volume() > 0 && step < 12; ++step) {
    CHECK(cut.update(0.1 * step));
    CHECK(cut.dropped_volume() < before);
    before = cut.dropped_volume();
  }
  CHECK(before == 0);
  CHECK(cut.mesh().find_parts().volume.size() == 1);
}

namespace {

/// A pond with a chamber whose width is read by its walls, and what is known of its nodes.
struct Chambered {
  explicit Chambered(double first) : width(first) {
    for (int k = 0; k < 4; ++k)
      pond.cut.add_body([this, k](double) { return chamber(.43, .43 + width, .52, .52 + h)[k]; });
  }
  /// The first cut of a step to `time`; what it drops, in cells.
  double step(double time, double to) {
    pond.cut.begin_step();
    width = to;
    pond.cut.update(time);
    return pond.cut.dropped_volume() / (h * h);
  }
  static constexpr double h = 1.0 / 20;
  Pond pond{20};
  double width;
};

}  // namespace

TEST_CASE("A step that failed leaves no trace in what is dropped", "[cut][parts][ranks]") {
  constexpr double h = Chambered::h;
  Chambered tried(2.1 * h);
  CHECK(tried.step(0, 2.1 * h) == 0);
  const StateStore::Snapshot before = tried.pond.field.state().snapshot(0);
  CHECK(tried.step(0.1, 1.8 * h) == Approx(1.8).epsilon(1e-9));
  tried.pond.field.state().restore(before);
  // Half the step again: the chamber is as large as it was and has been kept all the time.
  CHECK(tried.step(0.05, 2.1 * h) == 0);
}

TEST_CASE("A run that is resumed knows what was dropped", "[cut][parts][ranks]") {
  constexpr double h = Chambered::h;
  Chambered whole(h);
  CHECK(whole.step(0, h) == Approx(1).epsilon(1e-9));
  const StateStore& states = whole.pond.field.state();
  const StateStore::Snapshot memory = states.snapshot(0);
  CHECK(whole.step(0.1, 2.5 * h) == Approx(2.5).epsilon(1e-9));

  Chambered resumed(h);
  resumed.pond.field.state().restore(memory);
  resumed.pond.cut.update(0);  // as the states are read, before a step is begun
  CHECK(differences(states, resumed.pond.field.state().snapshot(0), memory).empty());
  CHECK(resumed.step(0.1, 2.5 * h) == Approx(2.5).epsilon(1e-9));
}

TEST_CASE("A part that comes alive far from all others has no state to start from", "[cut][parts][ranks]") {
  const double h = 1.0 / 20;
  Pond pond(20);
  FieldCut& cut = pond.cut;
  double width = -0.5 * h;  // the walls overlap
  for (int k = 0; k < 4; ++k)
    cut.add_body([&, k](double) { return chamber(.43, .43 + width, .52, .52 + h)[k]; });
  CHECK(cut.update(0));
  width = 2.5 * h;
  CHECK_THROWS_AS(cut.update(0), StepRefused);
}

TEST_CASE("What the first cut of a step keeps stays in for the step", "[cut][parts][ranks]") {
  const double h = 1.0 / 20;
  Pond pond(20);
  FieldCut& cut = pond.cut;
  double width = 2.1 * h;
  for (int k = 0; k < 4; ++k)
    cut.add_body([&, k](double) { return chamber(.43, .43 + width, .52, .52 + h)[k]; });
  CHECK(cut.update(0));
  width = 1.8 * h;
  CHECK(cut.update(0));
  CHECK(cut.dropped_volume() == 0);
  CHECK(cut.mesh().find_parts().volume.size() == 2);
  cut.begin_step();
  CHECK(cut.update(0));
  CHECK(cut.dropped_volume() == Approx(1.8 * h * h).epsilon(1e-12));
  cut.begin_step();
  CHECK_FALSE(cut.update(0));
}

TEST_CASE("What cells keep begins anew where a body has uncovered them, and only there", "[cut][parts]") {
  Pond pond(10);
  StateArray<double>& wear = pond.field.state().add<double>(
      {"wear", points_of_cells(pond.mesh, 4), 1, 2, WhenUncovered::initial}, 0.5);
  double radius = 0.25;
  pond.cut.add_body([&](double) { return circle({0.5, 0.5, 0}, radius, 40); });
  pond.cut.update(0);
  std::ranges::fill(wear.now(), 3.0);
  const StateStore::Snapshot before = pond.field.state().snapshot(0);
  const auto worn = [&] { return std::ranges::count(wear.now(), 3.0); };
  const auto all = worn();
  // A try that covers more, and is rewound.
  radius = 0.29;
  pond.cut.update(0.2);
  pond.field.state().restore(before);
  radius = 0.24;
  pond.cut.update(0.1);
  CHECK(worn() == all);
  // Smaller: 4 points of each cell that comes.
  const std::vector<char> covered = pond.cut.active_cells();
  radius = 0.21;
  pond.cut.update(0.2);
  std::ptrdiff_t fresh = 0;
  for (int c = 0; c < pond.mesh.cells(); ++c)
    fresh += covered[c] == 0 && pond.cut.active_cells()[c] != 0 ? 4 : 0;
  CHECK(fresh > 0);
  CHECK(worn() == all - fresh);
  CHECK(std::ranges::count(wear.now(), 0.5) == fresh);
  // In the step itself, too; what was there when it began stays.
  std::ranges::fill(wear.now(), 3.0);
  radius = 0.25;
  pond.cut.update(0.2);
  radius = 0.21;
  pond.cut.update(0.2);
  CHECK(worn() == all);
  pond.field.state().add<double>({"scar", cells_of(pond.mesh), 1, 1, WhenUncovered::refused});
  CHECK_FALSE(pond.cut.update(0.2));
  radius = 0.12;
  CHECK_THROWS_WITH(pond.cut.update(0.3), Catch::Contains("'scar' has nothing to begin with"));
}

TEST_CASE("Held cells keep their unknowns to the end of the step though a body covers them", "[cut][parts]") {
  Pond pond(10);
  FieldCut& cut = pond.cut;
  double radius = 0.21;
  cut.add_body([&](double) { return circle({0.5, 0.5, 0}, radius, 40); });
  const auto active = [&] { return std::count(cut.active_cells().begin(), cut.active_cells().end(), 1); };
  CHECK(cut.update(0));
  const auto before = active();
  cut.hold();
  radius = 0.29;
  CHECK(cut.update(0));
  CHECK(active() == before);
  // Cells without any fluid have no points to integrate at.
  CutRule rule;
  int covered = 0;
  for (int c = 0; c < pond.mesh.cells(); ++c) {
    if (cut.active_cells()[c] == 0 || cut.mesh().state(c) != CellState::body) continue;
    ++covered;
    CHECK(pond.field.is_cut(c));
    cut.mesh().volume_rule(c, 2, rule);
    CHECK(rule.count() == 0);
  }
  CHECK(covered > 0);
  cut.begin_step();
  radius = 0.28;
  CHECK(cut.update(0));
  CHECK(active() < before);
}

TEST_CASE("A piece laid onto the mouth of what is dropped stands for no more of its facet than it weighs",
          "[cut][parts]") {
  // An oblique channel, much narrower than a cell, whose upper half is dropped.
  const double wide = 1e-3;
  const auto wall = [](double left, double right) {
    return polygon(
        {{left - .05, .15, 0}, {right - .05, .15, 0}, {right + .05, .85, 0}, {left + .05, .85, 0}});
  };
  const Mesh mesh = grid(CellType::quadrilateral, {10, 10, 0}, unmoved());
  CutMesh cut(mesh);
  cut.cut(std::vector{wall(.25, .45), wall(.45 + wide, .65)});
  std::vector<int> upper;
  for (int c = 0; c < mesh.cells(); ++c)
    if (mesh.geometry(c)[1] > .49 && mesh.geometry(c)[1] < .89 && cut.state(c) == CellState::cut &&
        mesh.geometry(c)[0] > .39 && mesh.geometry(c)[0] < .51)
      upper.push_back(c);
  REQUIRE(cut.drop(upper) > 0);

  const double length = std::hypot(.1, .7);
  double laid = 0;
  for (const int c : cut.cut_cells()) {
    InterfaceRule rule;
    InterfaceMotion motion;
    cut.interface_rule(c, 2, rule, &motion);
    std::map<std::array<double, 4>, double> weight;  // of each piece: body, facet and where it is
    std::set<std::array<double, 4>> in_mouth;
    for (int q = 0; q < rule.count(); ++q) {
      const double from = rule.span[2 * q], to = rule.span[2 * q + 1];
      for (const int end : {0, 1})
        CHECK(motion.in_plane[q].span[end].v == Approx(rule.span[2 * q + end]).margin(1e-9));
      weight[{double(rule.body[q]), double(rule.facet[q]), from, to}] += rule.weight[q];
      if (std::abs(rule.normal[2 * q + 1]) > .999 && std::abs(rule.position[2 * q + 1] - .5) < 1e-9) {
        laid += rule.weight[q];
        in_mouth.insert({double(rule.body[q]), double(rule.facet[q]), from, to});
      }
    }
    for (const auto& [piece, sum] : weight) {
      const bool is_long = piece[1] == 1 || piece[1] == 3;
      const double covered = std::abs(piece[3] - piece[2]) * length;
      if (is_long) CHECK(covered <= sum * (1 + 1e-9));
      // And for no less: what is over is closed.
      if (is_long && in_mouth.contains(piece)) CHECK(covered == Approx(sum).epsilon(1e-6));
    }
  }
  CHECK(laid == Approx(wide).epsilon(1e-6));
}

TEST_CASE("A part of the field of just two cells is kept, and one of less is not", "[cut][parts][ranks]") {
  // All coordinates are exact in binary.
  constexpr double h = 1.0 / 16;
  for (const double height : {h, h - 1e-6}) {
    Pond pond(16);
    for (int k = 0; k < 4; ++k)
      pond.cut.add_body([=](double) { return chamber(6 * h, 8 * h, 8 * h, 8 * h + height)[k]; });
    pond.cut.update(0);
    CHECK(pond.cut.dropped_volume() == Approx(height < h ? 2 * h * height : 0).epsilon(1e-9));
  }
}

TEST_CASE("A film that drains is kept wherever its walls are beside mesh lines, until it has closed",
          "[cut][parts][ranks]") {
  constexpr double h = 1.0 / 16;
  const auto dropped = [&](Pond& pond) {
    pond.cut.begin_step();
    pond.cut.update(0);
    return pond.cut.dropped_volume();
  };
  // Of the film's walls each in its turn lets it drain; the upper one is a little above a mesh line, or
  // below.
  for (int drains = 0; drains < 4; ++drains)
    for (const double beside : {0.0, 1e-12, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, -1e-12, -1e-8, -1e-4}) {
      CAPTURE(drains, beside);
      Pond pond(16);
      for (int k = 0; k < 4; ++k)
        pond.cut.add_body([=](double) { return chamber(6.3 * h, 8.6 * h, 7.985 * h, (8 + beside) * h)[k]; });
      pond.cut.keep_at(drains);
      CHECK(dropped(pond) == 0);
    }
  // In cells; it comes back when it is thicker than it was when it closed.
  double height = 1e-2;
  Pond pond(16);
  for (int k = 0; k < 4; ++k)
    pond.cut.add_body([&, k](double) { return chamber(6.3 * h, 8.6 * h, 8.1 * h, (8.1 + height) * h)[k]; });
  for (int k = 0; k < 4; ++k) pond.cut.keep_at(k);
  for (const auto& [thickness, is_kept] :
       {std::pair(1e-2, true), std::pair(1e-4, true), std::pair(2e-6, false), std::pair(1e-4, false),
        std::pair(1e-2, true)}) {
    CAPTURE(thickness);
    height = thickness;
    CHECK(dropped(pond) == Approx(is_kept ? 0 : 2.3 * h * thickness * h).epsilon(1e-6));
  }
}

TEST_CASE("The trace size of a cell is its volume over its interface, but no more than four of its lengths",
          "[cut]") {
  constexpr double h = 0.25;
  double corner = 0;
  Pond pond(4);
  pond.cut.add_body([&](double) {
    return polygon({{-1, -1, 0}, {corner, -1, 0}, {corner, 0.01, 0}, {-1, 0.01, 0}});
  });
  // How far the body's corner reaches into the second cell of the lowest row.
  for (const double width : {0.2, 0.07, 0.01, 1e-6}) {
    CAPTURE(width);
    corner = h + width;
    pond.cut.begin_step();
    pond.cut.update(0);
    CHECK(pond.cut.trace_size(1) == Approx(std::min(h * h / (width + 0.01), 4 * h)).epsilon(1e-9));
  }
}
