// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/unite.hpp"

#include <algorithm>
#include <map>

#include "seam/cut/arrangement.hpp"

namespace seam::cutting {
namespace {

/// Segments with the same ends, of any bodies.
struct Group {
  LatticePoint a, b;         ///< a < b
  std::vector<int> members;  ///< segments
  int chain = -1;
};

class Union {
 public:
  explicit Union(const Facets& facets) : facets_(facets) {
    for (int f = 0; f < static_cast<int>(facets.list.size()); ++f) {
      const auto& v = facets.list[f].vertex;
      segments_.push_back({facets.point[v[0]], facets.point[v[1]], f});
    }
    split_ = split_at_meetings(segments_);
    arrange();
    make_groups();
  }

  /// @return false when all facets remain as they are
  bool build(Facets& result) {
    std::vector<int> kept(segments_.size(), 0);
    std::size_t kept_count = 0;
    for (const std::vector<int>& chain : chains()) {
      const int side = fluid_side(groups_[chain.front()]);
      const LatticePoint from = groups_[chain.front()].a;
      LatticePoint at = from;
      static_cast<void>(at);
      for (const int g : chain) {
        const int own = fluid_side_of_member(groups_[g], groups_[chain.front()], side);
        if (own < 0) continue;
        kept[own] = 1;
        ++kept_count;
      }
    }
    if (!split_ && kept_count == segments_.size()) return false;
    result = Facets{facets_.dimension, facets_.lattice, arranged_.point, arranged_.position, {}, facets_.far,
                    facets_.closed};
    for (std::size_t s = 0; s < segments_.size(); ++s)
      if (kept[s] != 0) result.list.push_back(arranged_.list[s]);
    return true;
  }

 private:
  void arrange();
  void make_groups();
  [[nodiscard]] std::vector<std::vector<int>> chains();
  int fluid_side(const Group& group);
  int fluid_side_of_member(const Group&, const Group&, int);

  const Facets& facets_;
  std::vector<Segment> segments_;
  bool split_ = false;
  Facets arranged_;  ///< the segments as facets, in the same order
  std::vector<Group> groups_;
};

}  // namespace
}  // namespace seam::cutting
