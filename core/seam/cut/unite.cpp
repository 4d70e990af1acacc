// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/unite.hpp"

#include <algorithm>
#include <map>

#include "seam/cut/arrangement.hpp"

namespace seam::cutting {
namespace {

/// Segments of any bodies with the same ends.
struct Group {
  std::array<int, 2> vertex;  ///< of the arrangement
  std::vector<int> members;   ///< segments
};

/// A group walked along from its first vertex to its second, or the other way.
struct Walk {
  int group;
  bool forward;
};

class Union {
 public:
  explicit Union(const Facets& facets) : facets_(facets) {
    std::vector<Segment> segments;
    for (int f = 0; f < static_cast<int>(facets.list.size()); ++f) {
      const auto& v = facets.list[f].vertex;
      segments.push_back({facets.point[v[0]], facets.point[v[1]], f});
    }
    split_ = split_at_meetings(segments);
    arrange(segments);
    make_groups();
  }

  /// @return whether the facets do not remain as they are
  bool build(Facets& result) {
    const std::vector<int> kept = choose();
    if (!split_ && kept.size() == facets_.list.size()) return false;
    result = std::move(arranged_);
    std::vector<Facet> list;
    for (const int s : kept) list.push_back(result.list[s]);
    result.list = std::move(list);
    return true;
  }

 private:
  /// Whether the left and the right of a group, from its first vertex to the second, are wet.
  struct Sides {
    bool left, right;
  };

  void arrange(const std::vector<Segment>& segments);
  void make_groups();
  std::vector<Walk> chain_through(int group);
  void extend(int vertex, bool ahead, std::vector<Walk>& chain);
  [[nodiscard]] std::vector<int> choose();
  [[nodiscard]] Sides sides(const Group& group) const;
  [[nodiscard]] std::vector<int> windings(const LatticePoint& point) const;

  const Facets& facets_;
  bool split_ = false;
  Facets arranged_;  ///< one facet per segment, with vertices shared by place
  std::vector<Group> groups_;
  std::vector<std::vector<int>> groups_at_;  ///< [vertex]
  std::vector<char> visited_;                ///< [group]
};

void Union::arrange(const std::vector<Segment>& segments) {
  arranged_ = {facets_.dimension, facets_.lattice, {}, {}, {}, facets_.far, facets_.closed, false,
               facets_.origin};
  std::map<LatticePoint, int> number;
  const auto vertex = [&](const LatticePoint& p, const Vector& x) {
    const auto [entry, is_new] = number.try_emplace(p, static_cast<int>(number.size()));
    if (is_new) {
      arranged_.point.push_back(p);
      arranged_.position.push_back(x);
    }
    return entry->second;
  };
  // Vertices of the bodies keep the position they were given.
  for (std::size_t v = 0; v < facets_.point.size(); ++v) vertex(facets_.point[v], facets_.position[v]);
  for (const Segment& s : segments) {
    const int a = vertex(s.a, facets_.lattice.position(s.a)), b = vertex(s.b, facets_.lattice.position(s.b));
    const Facet& source = facets_.list[s.facet];
    arranged_.list.push_back({{a, b, b}, source.body, source.facet, source.normal});
  }
}

void Union::make_groups() {
  std::map<std::array<int, 2>, int> number;
  for (int s = 0; s < static_cast<int>(arranged_.list.size()); ++s) {
    const auto& v = arranged_.list[s].vertex;
    const std::array<int, 2> ends{std::min(v[0], v[1]), std::max(v[0], v[1])};
    const auto [entry, is_new] = number.try_emplace(ends, static_cast<int>(groups_.size()));
    if (is_new) groups_.push_back({ends, {}});
    groups_[entry->second].members.push_back(s);
  }
  groups_at_.resize(arranged_.point.size());
  for (int g = 0; g < static_cast<int>(groups_.size()); ++g)
    for (const int v : groups_[g].vertex) groups_at_[v].push_back(g);
  visited_.assign(groups_.size(), 0);
}

/// Goes on where exactly two groups meet: there the sides stay what they are.
void Union::extend(int vertex, bool ahead, std::vector<Walk>& chain) {
  int last = chain.front().group;
  while (groups_at_[vertex].size() == 2) {
    const auto& two = groups_at_[vertex];
    const int next = two[0] == last ? two[1] : two[0];
    if (visited_[next] != 0) return;
    visited_[next] = 1;
    const bool starts_here = groups_[next].vertex[0] == vertex;
    chain.push_back({next, starts_here == ahead});
    vertex = groups_[next].vertex[starts_here ? 1 : 0];
    last = next;
  }
}

std::vector<Walk> Union::chain_through(int group) {
  std::vector<Walk> chain{{group, true}};
  visited_[group] = 1;
  extend(groups_[group].vertex[1], true, chain);
  extend(groups_[group].vertex[0], false, chain);
  return chain;
}

std::vector<int> Union::windings(const LatticePoint& point) const {
  LatticePoint far_away = point;
  far_away.x[0] = std::int64_t{1} << 51;
  std::vector<int> count = facets_.far;
  for (const Facet& f : arranged_.list)
    if (facets_.closed[f.body]) count[f.body] -= crossing(arranged_, f, point, far_away);
  for (std::size_t b = 0; b < count.size(); ++b)
    if (!facets_.closed[b]) count[b] = winding(arranged_, static_cast<int>(b), point);
  return count;
}

Union::Sides Union::sides(const Group& group) const {
  const LatticePoint &a = arranged_.point[group.vertex[0]], &b = arranged_.point[group.vertex[1]];
  // The middle is on the lattice. As a point of the mesh it is infinitesimally off the segments, on one side.
  const LatticePoint middle{{(a.x[0] + b.x[0]) / 2, (a.x[1] + b.x[1]) / 2, 0}};
  const std::vector<int> here = windings(middle);
  std::vector<int> other = here;
  const int side = side_of_facet(a, b, middle);
  for (const int s : group.members) {
    const Facet& f = arranged_.list[s];
    const int along = f.vertex[0] == group.vertex[0] ? 1 : -1;
    other[f.body] -= side * along;
  }
  const auto wet = [](const std::vector<int>& w) {
    return std::all_of(w.begin(), w.end(), [](int n) { return n <= 0; });
  };
  return side > 0 ? Sides{wet(here), wet(other)} : Sides{wet(other), wet(here)};
}

std::vector<int> Union::choose() {
  std::vector<int> kept;
  for (int g = 0; g < static_cast<int>(groups_.size()); ++g) {
    if (visited_[g] != 0) continue;
    const Sides wet = sides(groups_[g]);
    const std::vector<Walk> chain = chain_through(g);
    arranged_.all_covered = !wet.left;
    if (wet.left == wet.right) continue;
    for (const Walk& walk : chain) {
      // The body lies to the left of a facet.
      const int start = groups_[walk.group].vertex[walk.forward == wet.right ? 0 : 1];
      const auto& members = groups_[walk.group].members;
      const auto member = std::find_if(members.begin(), members.end(),
                                       [&](int s) { return arranged_.list[s].vertex[0] == start; });
      if (member != members.end()) kept.push_back(*member);
    }
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace

void unite_in_plane(Facets& facets) {
  Facets united;
  if (Union(facets).build(united)) facets = std::move(united);
}

}  // namespace seam::cutting
