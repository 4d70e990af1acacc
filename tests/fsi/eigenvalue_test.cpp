// SPDX-License-Identifier: BSD-3-Clause
// The eigenvalue that scales the penalty of the body's stress, thesis (3.31).
#include <catch2/catch.hpp>
#include <cmath>

#include "exact_state.hpp"
#include "kernels.hpp"
#include "seam/assembly/remote_cells.hpp"
#include "seam/field/field.hpp"
#include "seam/interface/cell_constant.hpp"
#include "seam/interface/cell_constants.hpp"
#include "seam/mesh/input/grid.hpp"
#include "seam/mesh/mesh.hpp"
#include "trace_eigenvalue.hpp"

using namespace seam;

namespace {

/// A square (or cube) of cells with a displacement that is linear in the position.
struct Body {
  int dim;
  std::unique_ptr<Mesh> mesh;
  std::unique_ptr<Field> field;

  Body(int dimension, double h, const std::vector<double>& gradient = {}) : dim(dimension) {
    Grid grid;
    grid.cell = dim == 2 ? CellType::quadrilateral : CellType::hexahedron;
    for (int d = 0; d < dim; ++d) grid.lines[d] = {0, h, 2 * h, 3 * h};
    mesh = std::make_unique<Mesh>("body", std::make_shared<MeshData>(make_grid(grid)), Communicator());
    field = std::make_unique<Field>("body", *mesh, std::vector<Unknown>{{"displacement", dim, 1, 2, "m"}});
    Block& block = field->blocks()[0];
    for (int n = 0; n < block.space->nodes() && !gradient.empty(); ++n)
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          block.now.value[n * dim + i] += gradient[i * dim + j] * block.space->position(n)[j];
  }

  /// lambda_e of the cell that has most (`corner`) or, in the plane, one of its faces on the surface.
  double lambda(const std::string& law, bool corner, double young = 100,
                CellConstant::Refresh refresh = CellConstant::Refresh::iteration, double poisson = 0.1) {
    const auto stress =
        std::make_shared<LawStress<solid::Piola>>(solid::Piola{test::material(law, young, poisson)});
    CellConstants constants(*field, field->place("displacement"));
    constants.add(std::make_shared<fsci::TraceEigenvalue>(stress, refresh), 0);
    const int cell = corner ? 0 : 1;
    std::vector<int> faces;
    for (const auto& [name, on] : mesh->boundaries())
      for (const CellFace& face : on)
        if (face.cell == cell) faces.push_back(face.face);
    REQUIRE(faces.size() == static_cast<std::size_t>(corner ? dim : dim - 1));
    return constants.value(0, 0, fetch_cells(*field, {cell})[0], faces);
  }
};

const std::vector<double> rotation{std::cos(0.7) - 1, -std::sin(0.7), std::sin(0.7), std::cos(0.7) - 1};

/// Q (1 + g) - 1
std::vector<double> rotated(const std::vector<double>& g) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  const double f[4] = {1 + g[0], g[1], g[2], 1 + g[3]};
  return {c * f[0] - s * f[2] - 1, c * f[1] - s * f[3], s * f[0] + c * f[2], s * f[1] + c * f[3] - 1};
}

}  // namespace

TEST_CASE("the eigenvalue of an edge and of a corner") {
  // lambda_e h at E = 100, nu = 0.1, undeformed: exact integration in rational numbers, power iteration.
  for (const double h : {1.0, 1.0 / 16}) {
    Body body(2, h);
    CHECK(h * body.lambda("neo_hookean", false) == Approx(134.2424562718).epsilon(1e-11));
    CHECK(h * body.lambda("neo_hookean", true) == Approx(177.8718496921).epsilon(1e-11));
  }
}

TEST_CASE("the eigenvalue scales with the stiffness and knows no direction") {
  Body body(2, 0.5);
  const double lambda = body.lambda("neo_hookean", true);
  CHECK(body.lambda("neo_hookean", true, 1e7) == Approx(1e5 * lambda).epsilon(1e-9));
  // All laws have the same small strains.
  CHECK(body.lambda("saint_venant_kirchhoff", true) == Approx(lambda).epsilon(1e-9));
  Body turned(2, 0.5, rotation);
  CHECK(turned.lambda("neo_hookean", true) == Approx(lambda).epsilon(1e-9));
  const std::vector<double> strain{0.3, 0.1, -0.05, 0.2};
  Body strained(2, 0.5, strain), strained_turned(2, 0.5, rotated(strain));
  const double deformed = strained.lambda("neo_hookean", true);
  CHECK(std::abs(deformed / lambda - 1) > 0.05);
  CHECK(strained_turned.lambda("neo_hookean", true) == Approx(deformed).epsilon(1e-9));
}

TEST_CASE("the update policy chooses the deformation") {
  Body body(2, 0.5, {0.2, 0.1, -0.05, -0.1});
  const double undeformed = Body(2, 0.5).lambda("neo_hookean", true);
  CHECK(body.lambda("neo_hookean", true, 100, CellConstant::Refresh::once) == undeformed);
  CHECK(body.lambda("neo_hookean", true, 100, CellConstant::Refresh::step) == undeformed);  // old state
  CHECK(body.lambda("neo_hookean", true) != undeformed);
}

TEST_CASE("a cell under uniform pressure is as stiff as its material, however high the pressure") {
  // At a stretch s with J = s^2 stresses change by 4c eps + k tr(eps) I, k = 2c((2 beta + 1) J^-(2 beta + 1)
  // - 1): as those of an undeformed cell of Lame's constants 2c and k.
  const double c = 100 / 4.4, beta = 0.125;
  for (const double s : {1.05, 0.9, 0.6, 0.35}) {
    Body pressed(2, 0.5, {s - 1, 0, 0, s - 1});
    const double k = 2 * c * ((2 * beta + 1) * std::pow(s, -4 * beta - 2) - 1);
    const double poisson = k / (2 * (k + 2 * c)), young = 4 * c * (1 + poisson);
    Body same(2, 0.5 * s);
    for (const bool corner : {false, true})
      CHECK(pressed.lambda("neo_hookean", corner) ==
            Approx(same.lambda("neo_hookean", corner, young, CellConstant::Refresh::iteration, poisson))
                .epsilon(1e-9));
  }
}

TEST_CASE("in space the corner of a cube exceeds its edge") {
  Body body(3, 0.25);
  const double corner = body.lambda("neo_hookean", true), edge = body.lambda("neo_hookean", false);
  CHECK(corner > edge);
  CHECK(Body(3, 1).lambda("neo_hookean", true) == Approx(0.25 * corner).epsilon(1e-9));
}
