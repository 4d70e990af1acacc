// SPDX-License-Identifier: BSD-3-Clause
// What is written of a field out of which bodies are cut: its own part and nothing else.
#include <fmt/format.h>
#include <vtkCell.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cli/run_command.hpp"

using namespace seam_cli_test;

namespace {

/// Shear flow u = height, which every order and every cut resolves exactly, around a body that goes with it.
std::string shear(int dimension, int order) {
  const bool plane = dimension == 2;
  const std::string walls = plane ? "x_min, y_min, y_max" : "x_min, y_min, y_max, z_min, z_max";
  const std::string speed = plane ? "[y, 0]" : "[z, 0, 0]";
  return fmt::format(R"(
title: Shear flow
dimension: {}
plugins: [cutfem_fluid]
meshes:
  channel: {{grid: {{from: {}, to: {}, cells: {}}}}}
fields:
  water:
    type: cutfem_fluid
    mesh: channel
    order: {}
    density: 1
    viscosity: 1
    boundary:
      - {{on: [{}], velocity: {}}}
      - {{on: x_max, outflow: do_nothing}}
interfaces:
  first: {{type: cut, field: water, body: {}}}
  second: {{type: cut, field: water, body: {}}}
coupling:
  - {{type: fluid_wall, on: first, velocity: {}}}
  - {{type: fluid_wall, on: second, velocity: {}}}
solver: {{newton: {{tolerance: 1e-12, increment_tolerance: 1e-10}}}}
)",
                     dimension, plane ? "[0, 0]" : "[0, 0, 0]", plane ? "[2, 1]" : "[2, 1, 1]",
                     plane ? "[13, 7]" : "[8, 5, 5]", order, walls, speed,
                     plane ? "{type: circle, centre: [0.8, 0.45], radius: 0.3}"
                           : "{type: sphere, centre: [0.8, 0.45, 0.5], radius: 0.3, refinements: 2}",
                     // Small enough to lie inside a single cell: a hole.
                     plane ? "{type: circle, centre: [1.462, 0.5], radius: 0.04}"
                           : "{type: sphere, centre: [1.625, 0.5, 0.5], radius: 0.06, refinements: 1}",
                     speed, speed);
}

/// Of a cell with corners first; those of four or eight corners are parallel to the axes.
double volume_of(vtkCell* cell) {
  double x[4][3] = {};
  const auto read = [&](int count) {
    for (int k = 0; k < count; ++k) cell->GetPoints()->GetPoint(k, x[k]);
  };
  const auto edge = [&](int k, int d) { return x[k][d] - x[0][d]; };
  if (cell->GetCellType() == VTK_TRIANGLE) {
    read(3);
    return 0.5 * (edge(1, 0) * edge(2, 1) - edge(1, 1) * edge(2, 0));
  }
  if (cell->GetCellType() == VTK_TETRA) {
    read(4);
    return (edge(1, 0) * (edge(2, 1) * edge(3, 2) - edge(2, 2) * edge(3, 1)) +
            edge(1, 1) * (edge(2, 2) * edge(3, 0) - edge(2, 0) * edge(3, 2)) +
            edge(1, 2) * (edge(2, 0) * edge(3, 1) - edge(2, 1) * edge(3, 0))) /
           6;
  }
  const double* b = cell->GetBounds();
  return (b[1] - b[0]) * (b[3] - b[2]) * (cell->GetCellDimension() == 3 ? b[5] - b[4] : 1);
}

template <class Reader>
void check_file(const std::string& path, int dimension, double volume) {
  CAPTURE(path);
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  double sum = 0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) sum += volume_of(grid->GetCell(c));
  CHECK(sum == Approx(volume).epsilon(1e-10));
  vtkDataArray* velocity = grid->GetPointData()->GetArray("velocity");
  REQUIRE(velocity != nullptr);
  double worst = 0;
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p) {
    const double height = grid->GetPoint(p)[dimension - 1];
    worst = std::max({worst, std::abs(velocity->GetComponent(p, 0) - height),
                      std::abs(velocity->GetComponent(p, 1)), std::abs(velocity->GetComponent(p, 2))});
  }
  CHECK(worst < 1e-10);
}

void check_runs(int dimension, int order, double volume) {
  const Folder folder;
  const std::string scene = folder.file("shear.yaml", shear(dimension, order));
  for (const int ranks : {1, 3}) {
    const std::string results = (folder.path / std::to_string(ranks)).string();
    const auto run = seam("run " + scene + " --quiet --no-picture --folder " + results,
                          fmt::format("mpirun --oversubscribe -np {}", ranks));
    CAPTURE(dimension, order, ranks, run.output);
    REQUIRE(run.code == 0);
    if (ranks == 1)
      check_file<vtkXMLUnstructuredGridReader>(results + "/fields/water-000001.vtu", dimension, volume);
    else
      check_file<vtkXMLPUnstructuredGridReader>(results + "/fields/water-000001.pvtu", dimension, volume);
  }
}

double disc(double radius) { return std::numbers::pi * radius * radius; }
double ball(double radius) { return 4 * std::numbers::pi / 3 * std::pow(radius, 3); }

}  // namespace

TEST_CASE("what is written of a cut field fills its part of the plane, with its values") {
  check_runs(2, 1, 2 - disc(0.3) - disc(0.04));
  check_runs(2, 2, 2 - disc(0.3) - disc(0.04));
}

TEST_CASE("what is written of a cut field fills its part of space, with its values", "[sanitized]") {
  check_runs(3, 1, 2 - ball(0.3) - ball(0.06));
}
