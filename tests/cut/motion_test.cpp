// SPDX-License-Identifier: BSD-3-Clause
// How the interface's points follow the body's vertices, against finite differences of the cut.
#include <catch2/catch.hpp>

#include "cut/cut_test.hpp"
#include "seam/cut/interface_motion.hpp"
#include "seam/surface/moving_facet.hpp"

using namespace seam;

namespace {

/// The cut before, at and after a small motion of all vertices.
struct Triple {
  CutMesh minus, at, plus;
  explicit Triple(const Mesh& mesh) : minus(mesh), at(mesh), plus(mesh) {}
};

/// Derivative of a number along the motion `direction` of the surface's points.
template <int dim>
double along(const Moves<dim, 1>& number, const Surface& surface, int facet,
             const std::vector<double>& direction) {
  double sum = 0;
  for (int v = 0; v < dim; ++v)
    for (int c = 0; c < dim; ++c)
      sum += number.d[v * dim + c] * direction[surface.facets[facet * dim + v] * dim + c];
  return sum;
}

/// @return points compared
template <int dim>
int compare(const Triple& cuts, const Surface& surface, const std::vector<double>& direction, double step) {
  InterfaceRule rule, before, after;
  InterfaceMotion motion;
  int compared = 0;
  for (const int cell : cuts.at.cut_cells()) {
    if (cuts.minus.state(cell) != CellState::cut || cuts.plus.state(cell) != CellState::cut) continue;
    cuts.at.interface_rule(cell, 3, rule, &motion);
    cuts.minus.interface_rule(cell, 3, before);
    cuts.plus.interface_rule(cell, 3, after);
    // Where a piece comes or goes there is no derivative.
    if (before.facet != rule.facet || after.facet != rule.facet) continue;
    INFO("cell " << cell << " of type " << static_cast<int>(cuts.at.mesh().type()));
    const auto same = [&](double exact, double high, double low) {
      CHECK((high - low) / (2 * step) == Approx(exact).epsilon(0).margin(2e-6 * (1 + std::abs(exact))));
    };
    double swept = 0;
    for (int q = 0; q < rule.count(); ++q, ++compared) {
      const int facet = rule.facet[q];
      const MovingPoint<dim, 1>& point = motion.points<dim>()[q];
      const auto move_of = [&](const Moves<dim, 1>& number) {
        return along<dim>(number, surface, facet, direction);
      };
      const auto here = static_cast<std::size_t>(q);
      double normal_motion = 0;
      for (int i = 0; i < dim; ++i) {
        const std::size_t k = here * dim + i;
        const double move = move_of(point.position[i]);
        same(move, after.position[k], before.position[k]);
        same(move_of(point.normal[i]), after.normal[k], before.normal[k]);
        normal_motion += move * rule.normal[k];
      }
      for (int i = 0; i + 1 < dim; ++i) {
        const std::size_t k = here * (dim - 1) + i;
        same(move_of(point.on_facet[i]), after.facet_reference[k], before.facet_reference[k]);
      }
      same(rule.weight[q] * move_of(point.relative_weight), after.weight[q], before.weight[q]);
      swept += rule.weight[q] * normal_motion;
    }
    // The fluid grows by what the interface sweeps.
    same(swept, cuts.plus.wet_volume(cell), cuts.minus.wet_volume(cell));
  }
  return compared;
}

int move_at_random(const Mesh& mesh, const Surface& surface, std::mt19937& random) {
  constexpr double step = 1e-6;
  std::uniform_real_distribution<double> part(-1, 1);
  std::vector<double> direction(surface.points.size());
  for (double& d : direction) d = part(random);
  Triple cuts(mesh);
  const auto cut_at = [&](CutMesh& cut, double s) {
    Surface shifted = surface;
    for (std::size_t k = 0; k < direction.size(); ++k) shifted.points[k] += s * direction[k];
    cut.cut(std::vector{shifted});
  };
  cut_at(cuts.minus, -step);
  cut_at(cuts.at, 0);
  cut_at(cuts.plus, step);
  return mesh.dimension() == 2 ? compare<2>(cuts, surface, direction, step)
                               : compare<3>(cuts, surface, direction, step);
}

}  // namespace

TEST_CASE("Points of the interface move with the body's vertices as finite differences say",
          "[cut][motion]") {
  std::mt19937 random(11);
  int compared = 0;
  for (const CellType type : {CellType::quadrilateral, CellType::triangle}) {
    const Mesh mesh = grid(type, {7, 6, 0}, rotated(2, 0.2, {1, 1, 1}, {0, 0, 0}));
    for (int k = 0; k < 10; ++k)
      compared += move_at_random(mesh, star(random, {0.4, 0.5, 0}, 0.3, 9), random);
  }
  for (const CellType type : {CellType::hexahedron, CellType::tetrahedron}) {
    const Mesh mesh = grid(type, {4, 4, 4}, rotated(3, 0.2, {1, 1, 1}, {0, 0, 0}));
    const Surface ball = moved(sphere({0, 0, 0}, 0.31, 1), rotated(3, 0.7, {1, 0.8, 1}, {0.5, 0.6, 0.55}));
    for (int k = 0; k < 2; ++k) compared += move_at_random(mesh, ball, random);
  }
  CHECK(compared > 3000);
}
