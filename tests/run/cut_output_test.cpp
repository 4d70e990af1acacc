// SPDX-License-Identifier: BSD-3-Clause
// The cut itself as it is written for pictures, read back and compared with what must hold of any cut.
#include <fmt/format.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "cli/run_command.hpp"

using namespace seam_cli_test;

namespace {

std::string scene(int dimension) {
  const bool plane = dimension == 2;
  return fmt::format(R"(
title: A body in a stream of its own speed
dimension: {}
plugins: [cutfem_fluid]
meshes:
  channel: {{grid: {{from: {}, to: {}, cells: {}}}}}
fields:
  water:
    type: cutfem_fluid
    mesh: channel
    density: 1
    viscosity: 1
    boundary:
      - {{on: [x_min], velocity: {}}}
      - {{on: x_max, outflow: do_nothing}}
interfaces:
  body: {{type: cut, field: water, body: {}}}
coupling:
  - {{type: fluid_wall, on: body, velocity: {}}}
output: {{fields: false, cut: true}}
)",
                     dimension, plane ? "[0, 0]" : "[0, 0, 0]", plane ? "[2, 1]" : "[2, 1, 1]",
                     plane ? "[13, 7]" : "[8, 5, 5]", plane ? "[1, 0]" : "[1, 0, 0]",
                     plane ? "{type: circle, centre: [0.8, 0.45], radius: 0.3}"
                           : "{type: box, from: [0.6, 0.3, 0.33], to: [1.1, 0.7, 0.77]}",
                     plane ? "[1, 0]" : "[1, 0, 0]");
}

/// A file of the last step, from one rank or several.
vtkNew<vtkUnstructuredGrid> read(const Folder& folder, const std::string& name) {
  vtkNew<vtkUnstructuredGrid> grid;
  const auto load = [&](auto& reader, const std::string& path) {
    reader->SetFileName(path.c_str());
    reader->Update();
    grid->DeepCopy(reader->GetOutput());
  };
  const std::string stem = (folder.path / "run/fields" / (name + "-000001")).string();
  if (std::filesystem::exists(stem + ".vtu")) {
    const vtkNew<vtkXMLUnstructuredGridReader> reader;
    load(reader, stem + ".vtu");
  } else {
    const vtkNew<vtkXMLPUnstructuredGridReader> reader;
    load(reader, stem + ".pvtu");
  }
  return grid;
}

int as_int(vtkDataArray* array, vtkIdType k) { return static_cast<int>(std::lround(array->GetTuple1(k))); }

/// Checks the cells against the volume of the fluid; returns the state of each global cell.
std::map<int, int> check_cells(const Folder& folder, double cell_volume, double volume, int count) {
  const auto grid = read(folder, "water-cells");
  vtkCellData* data = grid->GetCellData();
  REQUIRE(grid->GetNumberOfCells() == count);
  std::map<int, int> state;
  double sum = 0;
  for (vtkIdType c = 0; c < count; ++c) {
    const double share = data->GetArray("wet")->GetTuple1(c);
    const int s = as_int(data->GetArray("state"), c);
    CHECK((s == 1 ? share > 0 && share < 1 : share == (s == 0 ? 1 : 0)));
    sum += share * cell_volume;
    state[as_int(data->GetArray("cell"), c)] = s;
  }
  CHECK(sum == Approx(volume).epsilon(1e-12));
  CHECK(static_cast<int>(state.size()) == count);
  return state;
}

/// Area and closure of the interface; its points lie in cut cells.
void check_interface(const Folder& folder, const std::map<int, int>& state, double area) {
  const auto grid = read(folder, "water-interface");
  vtkPointData* data = grid->GetPointData();
  REQUIRE(grid->GetNumberOfCells() == grid->GetNumberOfPoints());
  double sum = 0, closure[3] = {}, enclosed = 0;
  for (vtkIdType q = 0; q < grid->GetNumberOfPoints(); ++q) {
    const double weight = data->GetArray("weight")->GetTuple1(q);
    sum += weight;
    for (int d = 0; d < 3; ++d) {
      closure[d] += weight * data->GetArray("normal")->GetComponent(q, d);
      enclosed -= weight * data->GetArray("normal")->GetComponent(q, d) * grid->GetPoint(q)[d];
    }
    CHECK(data->GetArray("body")->GetTuple1(q) == 0);
    CHECK(state.at(as_int(data->GetArray("cell"), q)) == 1);
  }
  CHECK(sum == Approx(area).epsilon(1e-10));
  for (const double c : closure) CHECK(std::abs(c) < 1e-12 * area);
  CHECK(enclosed > 0);  // normals point out of the fluid
}

/// Every face between two cells in the fluid, at least one of them cut, occurs once.
/// @param neighbours number of pairs of such cells
void check_ghost_faces(const Folder& folder, const std::map<int, int>& state, int neighbours) {
  const auto grid = read(folder, "water-ghost_faces");
  vtkCellData* data = grid->GetCellData();
  std::set<std::pair<int, int>> seen;
  for (vtkIdType f = 0; f < grid->GetNumberOfCells(); ++f) {
    const int a = as_int(data->GetArray("first_cell"), f), b = as_int(data->GetArray("second_cell"), f);
    const int states[2] = {state.at(a), state.at(b)};
    CHECK(std::max(states[0], states[1]) == 1);
    CHECK(seen.emplace(a, b).second);
    // Beside a whole cell the face is wet.
    if (std::min(states[0], states[1]) == 0) CHECK(data->GetArray("wet")->GetTuple1(f) == 1);
    CHECK(grid->GetCell(f)->GetNumberOfPoints() == (grid->GetCell(f)->GetCellDimension() == 1 ? 2 : 4));
  }
  CHECK(static_cast<int>(seen.size()) == neighbours);
}

/// Pairs of neighbouring cells in a grid numbered along x first, none in a body, one of them cut.
int ghost_pairs(const std::map<int, int>& state, const std::vector<int>& cells) {
  int count = 0;
  for (const auto& [cell, own] : state) {
    int stride = 1, rest = cell;
    for (const int n : cells) {
      if (rest % n + 1 < n) {
        const int other = state.at(cell + stride);
        count += std::max(own, other) == 1 ? 1 : 0;
      }
      rest /= n;
      stride *= n;
    }
  }
  return count;
}

}  // namespace

TEST_CASE("the cut is written for pictures: cells, interface and ghost faces") {
  struct Case {
    int dimension;
    std::vector<int> cells;
    double volume, area;
  };
  // A polygon of 720 sides with the area of the circle.
  const double step = std::numbers::pi / 720;
  const double radius = 0.3 * std::sqrt(2 * step / std::sin(2 * step));
  for (const Case& c : {Case{2, {13, 7}, 2 - 0.09 * std::numbers::pi, 1440 * radius * std::sin(step)},
                        Case{3, {8, 5, 5}, 2 - 0.5 * 0.4 * 0.44, 2 * (0.5 * 0.4 + 0.5 * 0.44 + 0.4 * 0.44)}})
    for (const int ranks : {1, 3}) {
      const Folder folder;
      const auto run = seam("run " + folder.file("cut.yaml", scene(c.dimension)) +
                                " --quiet --no-picture --folder " + (folder.path / "run").string(),
                            fmt::format("mpirun --oversubscribe -np {}", ranks));
      CAPTURE(c.dimension, ranks, run.output);
      REQUIRE(run.code == 0);
      int count = 1;
      for (const int n : c.cells) count *= n;
      const auto state = check_cells(folder, 2.0 / count, c.volume, count);
      check_interface(folder, state, c.area);
      check_ghost_faces(folder, state, ghost_pairs(state, c.cells));
      for (const char* kind : {"cells", "interface", "ghost_faces"})
        CHECK_THAT(folder.read(fmt::format("run/water-{}.pvd", kind)), Catch::Contains("000001"));
    }
}

TEST_CASE("a cut cannot be written of a scene that has none") {
  const Folder folder;
  std::string text = scene(2);
  text.erase(text.find("interfaces:"), text.find("output:") - text.find("interfaces:"));
  const auto run = seam("run " + folder.file("whole.yaml", text) + " --quiet --no-picture --folder " +
                        (folder.path / "run").string());
  CHECK(run.code != 0);
  CHECK_THAT(run.output, Catch::Contains("there is no cut to write"));
}
