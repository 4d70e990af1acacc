// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "seam/base/diagnostics.hpp"
#include "seam/constraint/constraint.hpp"
#include "seam/field/field.hpp"
#include "seam/plugin/plugin.hpp"

namespace {

using namespace seam;
using Vector3 = std::array<double, 3>;

/// One end: a node of a body, the same on all ranks.
struct End {
  Field* field = nullptr;
  Field::ComponentRange place{};
  UnknownPlace node;
  [[nodiscard]] UnknownPlace component(int c) const {
    UnknownPlace result = node;
    result.component = place.offset + c;
    return result;
  }
};

/// A rigid rod without mass that joins two nodes by hinges: their distance d stays L. Of the first node's
/// displacement a, that component k along which d is longest follows from the others and that of the second,
/// b: d_k = +-sqrt(L^2 - sum of the squares of the others), so that da_k = -d_j/d_k da_j + d_j/d_k db_j; the
/// rod's force does no work, so that the same coefficients hand on the balance.
class Rod final : public Constraint {
 public:
  explicit Rod(const Parameters& p) : where_(p.where()), names_(p.names("fields")) {
    if (names_.size() != 2) throw Error(p.where("fields"), "a rod joins two fields, which may be the same");
    at_ = {p.vector("from"), p.vector("to")};
  }

  void build(ConstraintSetup& setup) override {
    for (std::size_t e = 0; e < 2; ++e) {
      ends_[e].field = &setup.field(names_[e]);
      ends_[e].place = ends_[e].field->place("displacement");
    }
  }

  void tie(Ties& ties, const TimePoint&) const override {
    const int dim = ends_[0].field->mesh().dimension();
    std::array<End, 2> ends = ends_;
    std::array<Vector3, 2> moved{};
    for (std::size_t e = 0; e < 2; ++e) find(ties, ends[e], at_[e], moved[e]);
    Vector3 d{}, d0{};
    double square = 0;
    int k = 0;
    for (int c = 0; c < dim; ++c) {
      d0[c] = ends[0].node.position[c] - ends[1].node.position[c];
      d[c] = d0[c] + moved[0][c] - moved[1][c];
      square += d0[c] * d0[c];
      if (std::abs(d[c]) > std::abs(d[k])) k = c;
    }
    for (int c = 0; c < dim; ++c)
      if (c != k) square -= d[c] * d[c];
    if (square <= 0) throw StepRefused("a rod would have to be longer than it is");
    const double along = std::copysign(std::sqrt(square), d[k]);
    std::vector<TiedTo> to;
    double value = along - d0[k] + moved[1][k], linear = 0;
    for (int c = 0; c < dim; ++c) {
      const double ratio = d[c] / along;
      if (c != k) to.push_back({ends[0].component(c), -ratio, -ratio});
      to.push_back({ends[1].component(c), c == k ? 1 : ratio, c == k ? 1 : ratio});
      linear += (c == k ? 0 : -ratio * moved[0][c]) + (c == k ? 1 : ratio) * moved[1][c];
    }
    ties.tie(ends[0].component(k), std::move(to), value - linear);
    // The ratio d_c/d_k changes with d_c, and with d_k as that follows: d(d_k) = -d_m/d_k d(d_m).
    for (int c = 0; c < dim; ++c)
      for (int m = 0; m < dim; ++m) {
        if (c == k || m == k) continue;
        const double slope = ((c == m ? 1 : 0) + d[c] * d[m] / (along * along)) / along;
        for (const auto& [end, sign] : {std::pair{0, 1.0}, std::pair{1, -1.0}}) {
          ties.add_change(ends[0].component(c), ends[end].component(m), -sign * slope);
          ties.add_change(ends[1].component(c), ends[end].component(m), sign * slope);
        }
      }
  }

 private:
  /// The node next to x, wherever it lies, and its displacement.
  void find(const Ties& ties, End& end, const std::vector<double>& x, Vector3& moved) const {
    struct Candidate {
      double distance;
      UnknownPlace place;
      Vector3 moved;
    };
    const Block& block = end.field->blocks()[end.place.block];
    const int dim = end.field->mesh().dimension();
    std::optional<Candidate> best;
    for (int n = 0; n < block.space->owned_nodes(); ++n) {
      double distance = 0;
      for (int c = 0; c < dim; ++c) distance += std::pow(block.space->position(n)[c] - x[c], 2);
      if (best && best->distance <= distance) continue;
      best = Candidate{distance, ties.place(*end.field, end.place.block, n, end.place.offset), {}};
      for (int c = 0; c < dim; ++c)
        best->moved[c] = block.now.value[static_cast<std::size_t>(n) * block.size + end.place.offset + c];
    }
    std::vector<Candidate> all;
    if (best) all.push_back(*best);
    all = end.field->mesh().communicator().gather_all(all);
    const Candidate* nearest = &all.front();
    for (const Candidate& c : all)
      if (c.distance < nearest->distance) nearest = &c;
    end.node = nearest->place;
    moved = nearest->moved;
  }

  Location where_;
  std::vector<std::string> names_;
  std::array<std::vector<double>, 2> at_;
  std::array<End, 2> ends_;
};

}  // namespace

SEAM_PLUGIN(registry) {
  Schema schema("A rigid rod without mass between nodes of two bodies.");
  schema.names("fields", "those that its ends are hinged to").naming("field");
  schema.vector("from", "where it begins: the node next to it").unit("m");
  schema.vector("to", "where it ends").unit("m");
  registry.add<Constraint>("constraint", "rod", schema,
                           [](const Parameters& p, const Registry&) { return std::make_unique<Rod>(p); });
}
