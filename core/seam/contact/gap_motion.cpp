// SPDX-License-Identifier: BSD-3-Clause
#include "seam/contact/gap_motion.hpp"

#include <cmath>

#include "seam/cut/lattice.hpp"

namespace seam {
namespace {

using namespace cutting;

/// Derivatives of one pair along one direction in the space of all vertices.
class Variation {
 public:
  explicit Variation(const FacetPair& pair) : dim_(pair.dimension), gap_(pair.gap) {
    for (int k = 0; k < 3; ++k) {
      own_share_[k] = k == 0 ? 1 - pair.on_own[0] - pair.on_own[1] : pair.on_own[k - 1];
      opposite_share_[k] = k == 0 ? 1 - pair.on_opposite[0] - pair.on_opposite[1] : pair.on_opposite[k - 1];
    }
    for (int k = 1; k < dim_; ++k) {
      own_edge_[k - 1] = pair.own[k] - pair.own[0];
      opposite_edge_[k - 1] = pair.opposite[k] - pair.opposite[0];
    }
    const Vector area = facet_normal(dim_, pair.own);
    size_ = std::sqrt(dot(area, area));
    normal_ = (1 / size_) * area;
    facing_ = facet_normal(dim_, pair.opposite);
    gram_[0] = dot(opposite_edge_[0], opposite_edge_[0]);
    gram_[1] = dot(opposite_edge_[0], opposite_edge_[1]);
    gram_[2] = dot(opposite_edge_[1], opposite_edge_[1]);
  }
  /// Moves vertex k of one of the facets in direction c.
  /// @param slide how the point moves along its own facet meanwhile
  void move(int facet, int k, int c, const std::array<double, 2>& slide) {
    Vector shift{};
    shift[c] = 1;
    Vector turn{};
    weight = 0;
    if (facet == 0) {
      const Vector area = area_change(k, shift);
      weight = dot(area, normal_) / size_;
      turn = (1 / size_) * (area - dot(area, normal_) * normal_);
    }
    normal = turn;
    const Vector own =
        (facet == 0 ? own_share_[k] : 0.0) * shift + slide[0] * own_edge_[0] + slide[1] * own_edge_[1];
    const Vector opposite = (facet == 1 ? opposite_share_[k] : 0.0) * shift;
    // opposite + edges * on_opposite = own + gap * normal + gap_ * turn, and edges are normal to facing_.
    const Vector known = own + gap_ * turn - opposite;
    gap = -dot(facing_, known) / dot(facing_, normal_);
    solve(known + gap * normal_);
  }
  Vector normal{};
  double weight = 0, gap = 0;
  std::array<double, 2> on_opposite{};

 private:
  [[nodiscard]] Vector area_change(int k, const Vector& shift) const {
    if (dim_ == 2) {
      Vector change{};
      const double sign = k == 0 ? -1 : 1;
      change[0] = sign * shift[1];
      change[1] = -sign * shift[0];
      return change;
    }
    if (k == 1) return cross(shift, own_edge_[1]);
    if (k == 2) return cross(own_edge_[0], shift);
    return cross(shift, own_edge_[0]) - cross(shift, own_edge_[1]);
  }
  void solve(const Vector& way) {
    const double first = dot(opposite_edge_[0], way);
    if (dim_ == 2) {
      on_opposite[0] = first / gram_[0];
      return;
    }
    const double second = dot(opposite_edge_[1], way);
    const double determinant = gram_[0] * gram_[2] - gram_[1] * gram_[1];
    on_opposite = {(gram_[2] * first - gram_[1] * second) / determinant,
                   (gram_[0] * second - gram_[1] * first) / determinant};
  }
  int dim_;
  double gap_, size_ = 0;
  std::array<double, 3> own_share_{}, opposite_share_{}, gram_{};
  std::array<Vector, 2> own_edge_{}, opposite_edge_{};
  Vector normal_{}, facing_{};
};

}  // namespace

std::array<double, 3> facet_normal(int dimension, const std::array<std::array<double, 3>, 3>& vertices) {
  const Vector first = vertices[1] - vertices[0];
  if (dimension == 2) return {first[1], -first[0], 0};
  return cross(first, vertices[2] - vertices[0]);
}

PairMotion pair_motion(const FacetPair& pair, int moves, const std::vector<double>& slide) {
  const auto dim = static_cast<std::size_t>(pair.dimension), n = static_cast<std::size_t>(moves);
  PairMotion motion{std::vector<double>(dim * n), std::vector<double>(n), std::vector<double>(n),
                    std::vector<double>((dim - 1) * n)};
  Variation variation(pair);
  for (int m = 0; m < moves; ++m) {
    const int size = pair.dimension * pair.dimension;
    std::array<double, 2> along{};
    for (std::size_t d = 0; d + 1 < dim && !slide.empty(); ++d) along[d] = slide[d * n + m];
    variation.move(m / size, m % size / pair.dimension, m % pair.dimension, along);
    for (std::size_t d = 0; d < dim; ++d) motion.normal[d * n + m] = variation.normal[d];
    motion.relative_weight[m] = variation.weight;
    motion.gap[m] = variation.gap;
    for (std::size_t d = 0; d + 1 < dim; ++d) motion.on_opposite[d * n + m] = variation.on_opposite[d];
  }
  return motion;
}

}  // namespace seam
