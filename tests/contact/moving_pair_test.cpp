// SPDX-License-Identifier: BSD-3-Clause
// How gap, normal, area and opposite point follow the vertices of two facets, against finite differences.
#include "seam/contact/moving_pair.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "seam/conformance/finite_difference.hpp"
#include "seam/contact/facet_search.hpp"
#include "seam/cut/facet_vertices.hpp"

using namespace seam;

namespace {

/// All that a pair's vertices determine: normal, area, gap, place on the opposite facet.
std::vector<double> state(const FacetPair& pair, const std::array<double, 2>& on_own) {
  const int dim = pair.dimension;
  std::array<double, 3> normal = facet_normal(dim, pair.own), x = pair.own[0];
  const double area = std::hypot(normal[0], normal[1], normal[2]);
  for (int d = 0; d < 3; ++d) {
    normal[d] /= area;
    for (int k = 1; k < dim; ++k) x[d] += on_own[k - 1] * (pair.own[k][d] - pair.own[0][d]);
  }
  Surface opposite;
  opposite.dimension = dim;
  for (int k = 0; k < dim; ++k) {
    opposite.points.insert(opposite.points.end(), pair.opposite[k].begin(), pair.opposite[k].begin() + dim);
    opposite.facets.push_back(k);
  }
  const auto hit = FacetSearch(opposite).find(x.data(), normal.data(), 10, 10);
  REQUIRE(hit);
  std::vector<double> result(normal.begin(), normal.begin() + dim);
  result.insert(result.end(), {area, hit->gap});
  result.insert(result.end(), hit->on_facet.begin(), hit->on_facet.begin() + dim - 1);
  return result;
}

template <int dim>
void compare(const FacetPair& pair, const std::array<double, 2>& on_own, const std::vector<double>& at) {
  MovingPair<dim> moving(pair);
  moving.look();
  CHECK(moving.gap.v == Approx(at[dim + 1]).epsilon(0).margin(1e-12));
  for (int k = 0; k + 1 < dim; ++k)
    CHECK(moving.on_opposite[k].v == Approx(at[dim + 2 + k]).epsilon(0).margin(1e-12));
  for (int m = 0; m < 2 * dim * dim; ++m) {
    const int facet = m / (dim * dim), vertex = m % (dim * dim) / dim, component = m % dim;
    const auto difference = central_difference(
        [&](double step) {
          FacetPair moved = pair;
          (facet == 0 ? moved.own : moved.opposite)[vertex][component] += step;
          return state(moved, on_own);
        },
        1e-3);
    for (int d = 0; d < dim; ++d)
      CHECK(moving.normal[d].d[m] == Approx(difference[d]).epsilon(0).margin(1e-9));
    CHECK(moving.relative_weight.d[m] * at[dim] == Approx(difference[dim]).epsilon(0).margin(1e-9));
    CHECK(moving.gap.d[m] == Approx(difference[dim + 1]).epsilon(0).margin(1e-9));
    for (int k = 0; k + 1 < dim; ++k)
      CHECK(moving.on_opposite[k].d[m] == Approx(difference[dim + 2 + k]).epsilon(0).margin(1e-9));
  }
}

}  // namespace

TEST_CASE("the motion of a pair of facets is that of finite differences") {
  const int dim = GENERATE(2, 3);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-0.2, 0.2);
  for (int sample = 0; sample < 50; ++sample) {
    FacetPair pair;
    pair.dimension = dim;
    // Facets of size 1, the second turned over and about 0.3 away.
    if (dim == 2) {
      pair.own = {{{1, 0, 0}, {0, 0, 0}, {}}};
      pair.opposite = {{{-0.5, 0.3, 0}, {1.5, 0.3, 0}, {}}};
    } else {
      pair.own = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
      pair.opposite = {{{-1, -1, 0.3}, {-1, 3, 0.3}, {3, -1, 0.3}}};
    }
    for (int k = 0; k < dim; ++k)
      for (int d = 0; d < dim; ++d) {
        pair.own[k][d] += any(random);
        pair.opposite[k][d] += any(random);
      }
    const std::array<double, 2> on_own{0.3, dim == 3 ? 0.4 : 0.0};
    const std::vector<double> at = state(pair, on_own);
    pair.on_own = on_own;
    pair.gap = at[dim + 1];
    for (int k = 0; k + 1 < dim; ++k) pair.on_opposite[k] = at[dim + 2 + k];
    if (dim == 2)
      compare<2>(pair, on_own, at);
    else
      compare<3>(pair, on_own, at);
  }
}
