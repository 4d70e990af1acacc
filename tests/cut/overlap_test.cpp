// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/overlap.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using seam::Surface;
using seam::vertex_inside;

namespace {

/// A square or a cube with sides of one, its least corner at x = y = z = `from` or (from, 0, 0).
Surface box(int dimension, double from, bool along_x_only = false) {
  Surface s;
  s.dimension = dimension;
  for (int v = 0; v < 1 << dimension; ++v)
    for (int d = 0; d < dimension; ++d)
      s.points.push_back(((v >> d) & 1) + (d == 0 || !along_x_only ? from : 0.0));
  if (dimension == 2)
    s.facets = {0, 1, 1, 3, 3, 2, 2, 0};
  else
    s.facets = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return s;
}

}  // namespace

TEST_CASE("bodies overlap where a vertex of one lies within the other") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const Surface one = box(dimension, 0);
    const auto at = vertex_inside(one, box(dimension, 0.6));
    REQUIRE(at);
    // It is within both.
    for (const double x : *at) CHECK((x > 0.59 && x < 1.01));
    CHECK(vertex_inside(box(dimension, -0.6), one));
    // Apart, or with a corner or a side in common.
    for (const double from : {1.0, 1.2, -1.0}) {
      CHECK_FALSE(vertex_inside(one, box(dimension, from)));
      CHECK_FALSE(vertex_inside(one, box(dimension, from, true)));
    }
    // Near the box around a body, but not within it: a corner that is cut away.
    Surface cut = one;
    std::fill(cut.points.end() - dimension, cut.points.end(), 0.4);
    CHECK_FALSE(vertex_inside(cut, box(dimension, 0.6)));
    // A body around a hole overlaps what its surface goes through, not what lies in the hole.
    Surface turned = one;
    for (std::size_t f = 0; f < turned.facets.size(); f += dimension)
      std::swap(turned.facets[f], turned.facets[f + 1]);
    CHECK(vertex_inside(turned, box(dimension, 0.6)));
    Surface small = box(dimension, 0);
    for (double& x : small.points) x = 0.3 + 0.4 * x;
    CHECK(vertex_inside(one, small));
    CHECK_FALSE(vertex_inside(turned, small));
    const std::vector<double> middle(3, 0.5), outside(3, 1.5);
    CHECK(seam::is_inside(one, middle.data()));
    CHECK_FALSE(seam::is_inside(one, outside.data()));
    CHECK_FALSE(seam::is_inside(turned, middle.data()));
    // What is open has none.
    Surface open = one;
    open.closed = false;
    CHECK_FALSE(vertex_inside(open, box(dimension, 0.6)));
  }
}
