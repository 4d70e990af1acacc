// SPDX-License-Identifier: BSD-3-Clause
#include "cut/cut_test.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace seam;

int check_closure(const CutMesh& cut) {
  const Mesh& mesh = cut.mesh();
  const int dim = mesh.dimension();
  for (const int cell : cut.cut_cells()) {
    const double volume = cut.cell_volume(cell), size = std::pow(volume, (dim - 1.0) / dim);
    const Point open = closure(cut, cell);
    // Relative to the larger of a cell's face and the interface in it.
    const double scale = std::max(size, cut.interface_area(cell));
    // Curved sides are cut as polygons or polyhedra, whose normals the rule on a side does not know.
    const bool flat = has_flat_sides(mesh, cell);
    INFO("cell " << cell << ": open by " << open[0] / scale << ", " << open[1] / scale << ", "
                 << open[2] / scale);
    for (int i = 0; flat && i < dim; ++i) REQUIRE(std::abs(open[i]) / scale <= 1e-12);
    if (flat) REQUIRE(std::abs(flux_of_position(cut, cell) / dim - cut.wet_volume(cell)) <= 1e-12 * volume);
    REQUIRE(cut.wet_volume(cell) >= 0);
    REQUIRE(cut.wet_volume(cell) <= volume * (1 + 1e-12));
    REQUIRE(cut.interface_area(cell) > 0);
  }
  return static_cast<int>(cut.cut_cells().size());
}

void check_complement(const CutMesh& cut, const CutMesh& complement) {
  const auto fluid = [](const CutMesh& c, int cell) {
    if (c.state(cell) == CellState::cut) return c.wet_volume(cell);
    return c.state(cell) == CellState::wet ? 1e300 : 0.0;
  };
  for (int cell = 0; cell < cut.mesh().cells(); ++cell) {
    const double a = fluid(cut, cell), b = fluid(complement, cell);
    double volume = 0;
    if (cut.state(cell) == CellState::cut) volume = cut.cell_volume(cell);
    if (complement.state(cell) == CellState::cut) volume = complement.cell_volume(cell);
    INFO("cell " << cell << ": " << a / volume << " and " << b / volume << " of its volume");
    if (volume == 0) {
      REQUIRE(a + b == 1e300);
    } else {
      // Parts below 1e-11 are not kept: more than that is not missing, up to the rounding of both parts.
      const bool dropped = a == 0 || b == 0 || a > volume || b > volume;
      const double error = std::abs(std::min(a, volume) + std::min(b, volume) - volume) / volume;
      REQUIRE(error <= (dropped ? 1e-11 + 1e-12 : 1e-12));
    }
  }
}
