// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/level_set.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "seam/base/diagnostics.hpp"
#include "seam/cut/outline.hpp"

namespace seam {
namespace {

using namespace cutting;

struct Sample {
  Vector position;
  double value;
};

/// Where the function vanishes between two samples, the same whichever comes first.
Vector zero_between(const Sample& a, const Sample& b) {
  if (a.value == 0) return a.position;
  if (b.value == 0) return b.position;
  if (b.position < a.position) return zero_between(b, a);
  return a.position + a.value / (a.value - b.value) * (b.position - a.position);
}

/// Collects the corners of the facets in one simplex after the other.
class Marching {
 public:
  explicit Marching(int dimension) : dimension_(dimension) {}

  /// A positively oriented triangle or tetrahedron.
  void add(const std::array<Sample, 4>& s) {
    std::array<int, 4> negative{}, positive{};
    int below = 0, above = 0;
    for (int k = 0; k <= dimension_; ++k) (s[k].value < 0 ? negative[below++] : positive[above++]) = k;
    if (below == 0 || above == 0) return;
    if (below == 1)
      around(s, negative[0], true);
    else if (above == 1)
      around(s, positive[0], false);
    else
      between(s, negative, positive);
  }
  [[nodiscard]] const std::vector<double>& corners() const { return corners_; }

 private:
  void corner(const Vector& x) { corners_.insert(corners_.end(), x.begin(), x.begin() + dimension_); }
  void facet(const Vector& a, const Vector& b, const Vector& c, bool forward) {
    corner(forward ? a : b);
    corner(forward ? b : a);
    if (dimension_ == 3) corner(c);
  }
  /// Cuts off one vertex; it lies in the body or it alone does not.
  void around(const std::array<Sample, 4>& s, int vertex, bool in_body) {
    // The other vertices such that all four, or three, keep their orientation.
    static constexpr int others[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    static constexpr int others_in_plane[3][3] = {{1, 2, 2}, {2, 0, 0}, {0, 1, 1}};
    const int* o = dimension_ == 3 ? others[vertex] : others_in_plane[vertex];
    facet(zero_between(s[vertex], s[o[0]]), zero_between(s[vertex], s[o[1]]),
          zero_between(s[vertex], s[o[2]]), in_body);
  }
  /// Two vertices of a tetrahedron on each side: a quadrilateral.
  void between(const std::array<Sample, 4>& s, const std::array<int, 4>& in, const std::array<int, 4>& out) {
    const int i = in[0], j = in[1], k = out[0], l = out[1];
    int inversions = 0;
    const std::array<int, 4> order{i, j, k, l};
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b) inversions += order[a] > order[b] ? 1 : 0;
    const bool forward = inversions % 2 == 0;
    const Vector il = zero_between(s[i], s[l]), jl = zero_between(s[j], s[l]), jk = zero_between(s[j], s[k]),
                 ik = zero_between(s[i], s[k]);
    facet(il, jl, jk, forward);
    facet(il, jk, ik, forward);
  }

  int dimension_;
  std::vector<double> corners_;
};

Sample sample(int dimension, const Vector& x, const std::function<double(const double*)>& value) {
  const Sample result{x, value(x.data())};
  if (!std::isfinite(result.value))
    throw Error(fmt::format("the level set is {} at ({}); expected a finite number", result.value,
                            fmt::join(x.begin(), x.begin() + dimension, ", ")));
  return result;
}

/// Gives equal corners one number and finds out whether every facet has neighbours all round.
Surface join(int dimension, const std::vector<double>& corners) {
  Surface surface;
  surface.dimension = dimension;
  std::map<Vector, int> number;
  for (std::size_t c = 0; c < corners.size(); c += dimension) {
    Vector x{};
    for (int i = 0; i < dimension; ++i) x[i] = corners[c + i];
    const auto [entry, is_new] = number.try_emplace(x, static_cast<int>(number.size()));
    if (is_new) surface.points.insert(surface.points.end(), x.begin(), x.begin() + dimension);
    surface.facets.push_back(entry->second);
  }
  std::map<std::array<int, 2>, int> open;
  for (int f = 0; f < surface.facet_count(); ++f) {
    const int* v = &surface.facets[f * dimension];
    if (dimension == 2) {
      ++open[{v[0], v[0]}];
      --open[{v[1], v[1]}];
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      const int a = v[k], b = v[(k + 1) % 3];
      open[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : a > b ? -1 : 0;
    }
  }
  for (const auto& [rim, count] : open) surface.closed = surface.closed && count == 0;
  return surface;
}

}  // namespace

Surface level_set_surface(const Mesh& mesh, const std::function<double(const double*)>& value) {
  const Outline outline(mesh);
  const int dim = outline.dimension;
  std::vector<Sample> at_vertex;
  for (const Vector& x : outline.position) at_vertex.push_back(sample(dim, x, value));
  Marching marching(dim);
  for (int c = 0; c < mesh.owned_cells(); ++c) {
    const Sample centre = sample(dim, outline.centre(c), value);
    for (int s = outline.first_side[c]; s < outline.first_side[c + 1]; ++s) {
      const auto& v = outline.sides[s].vertex;
      marching.add({centre, at_vertex[v[0]], at_vertex[v[1]], at_vertex[v[2]]});
    }
  }
  return join(dim, mesh.communicator().gather_all(marching.corners()));
}

}  // namespace seam
