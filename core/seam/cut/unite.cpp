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
  Union(const Facets& facets, const Border& border) : facets_(facets) {
    std::vector<Segment> segments;
    for (int f = 0; f < static_cast<int>(facets.list.size()); ++f) {
      const auto& v = facets.list[f].vertex;
      segments.push_back({facets.point[v[0]], facets.point[v[1]], f});
    }
    split_ = split_at_meetings(segments);
    parts_ = segments;
    for (std::size_t k = 0; k < segments.size(); ++k) segments[k].facet = static_cast<int>(k);
    if (std::find(facets.closed.begin(), facets.closed.end(), false) != facets.closed.end()) {
      for (const Border::Side& side : border.sides())
        segments.push_back(
            {facets.lattice.round(side.corner[0]), facets.lattice.round(side.corner[1]), of_border});
      split_at_meetings(segments);
    }
    arrange(segments);
    make_groups();
  }

  /// @return whether the facets do not remain as they are
  bool build(Facets& result) {
    std::vector<Facet> list;
    bool whole = !split_;
    const std::vector<int> kept = choose();
    std::vector<int> pieces(parts_.size(), 0);
    for (const int part : part_) ++pieces[part];
    for (auto first = kept.begin(); first != kept.end();) {
      const int part = part_[*first];
      const auto end = std::find_if(first, kept.end(), [&](int s) { return part_[s] != part; });
      if (end - first == pieces[part]) {
        // The border divides nothing.
        const int last = arranged_.list[*(end - 1)].vertex[1];
        list.push_back(arranged_.list[*first]);
        list.back().vertex = {list.back().vertex[0], last, last};
      } else {
        whole = false;
        for (auto s = first; s != end; ++s) list.push_back(arranged_.list[*s]);
      }
      first = end;
    }
    if (whole && list.size() == facets_.list.size()) return false;
    result = std::move(arranged_);
    result.list = std::move(list);
    return true;
  }

 private:
  /// Whether the left and the right of a group, from its first vertex to the second, are wet.
  struct Sides {
    bool left, right;
  };

  void arrange(const std::vector<Segment>& segments);
  void find_ends(const std::vector<Segment>& segments, const std::map<LatticePoint, int>& number);
  void make_groups();
  std::vector<Walk> chain_through(int group);
  void extend(int vertex, bool ahead, std::vector<Walk>& chain);
  [[nodiscard]] std::vector<int> choose();
  [[nodiscard]] Sides sides(const Group& group) const;
  [[nodiscard]] std::vector<int> windings(const LatticePoint& point) const;
  [[nodiscard]] bool is_in_mesh(const Group& group) const;
  [[nodiscard]] LatticePoint middle(const Group& group) const;

  static constexpr int of_border = -1;
  const Facets& facets_;
  bool split_ = false;
  std::vector<Segment> parts_;   ///< of the facets, between where they meet
  std::vector<int> part_;        ///< [facet of arranged_], which may be a piece of it
  std::vector<Segment> border_;  ///< of the mesh; empty where all surfaces are closed
  Facets arranged_;              ///< one facet per segment, with vertices shared by place
  std::vector<Group> groups_;
  std::vector<std::vector<int>> groups_at_;  ///< [vertex]
  std::vector<char> visited_;                ///< [group]
  std::vector<char> is_rim_, at_border_;     ///< [vertex]: where an open surface ends; of the mesh
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
    if (s.facet == of_border) continue;
    const int a = vertex(s.a, facets_.lattice.position(s.a)), b = vertex(s.b, facets_.lattice.position(s.b));
    const Facet& source = facets_.list[parts_[s.facet].facet];
    part_.push_back(s.facet);
    arranged_.list.push_back({{a, b, b}, source.body, source.facet, source.normal});
  }
  find_ends(segments, number);
}

/// Rims of open surfaces, and where anything meets the border: behind it such a surface may end.
void Union::find_ends(const std::vector<Segment>& segments, const std::map<LatticePoint, int>& number) {
  is_rim_.assign(arranged_.point.size(), 0);
  at_border_ = is_rim_;
  std::copy_if(segments.begin(), segments.end(), std::back_inserter(border_),
               [](const Segment& s) { return s.facet == of_border; });
  for (const Segment& s : border_)
    for (const LatticePoint& end : {s.a, s.b})
      if (const auto found = number.find(end); found != number.end()) at_border_[found->second] = 1;
  std::map<std::array<int, 2>, int> ends;  // by vertex and body: those that end there less those that start
  for (const Facet& f : arranged_.list)
    if (!facets_.closed[f.body]) {
      --ends[{f.vertex[0], f.body}];
      ++ends[{f.vertex[1], f.body}];
    }
  for (const auto& [where, count] : ends)
    if (count != 0) is_rim_[where[0]] = 1;
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

/// Goes on where exactly two groups meet and no surface ends: there the sides stay what they are. Out of the
/// mesh it goes by one group, which the border's own edges need; behind it a surface may end anywhere.
void Union::extend(int vertex, bool ahead, std::vector<Walk>& chain) {
  int last = chain.front().group;
  while (groups_at_[vertex].size() == 2 && is_rim_[vertex] == 0) {
    const auto& two = groups_at_[vertex];
    const int next = two[0] == last ? two[1] : two[0];
    if (visited_[next] != 0) return;
    visited_[next] = 1;
    const bool starts_here = groups_[next].vertex[0] == vertex;
    chain.push_back({next, starts_here == ahead});
    if (at_border_[vertex] != 0 && !is_in_mesh(groups_[next])) return;
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
  const LatticePoint end = far_from(point);
  std::vector<int> count = facets_.far;
  for (const Facet& f : arranged_.list)
    if (facets_.closed[f.body]) count[f.body] -= crossing(arranged_, f, point, end);
  for (std::size_t b = 0; b < count.size(); ++b)
    if (!facets_.closed[b]) count[b] = winding(arranged_, static_cast<int>(b), point);
  return count;
}

/// It is on the lattice. As a point of the mesh it is infinitesimally off the segments, on one side.
LatticePoint Union::middle(const Group& group) const {
  const LatticePoint &a = arranged_.point[group.vertex[0]], &b = arranged_.point[group.vertex[1]];
  return {{(a.x[0] + b.x[0]) / 2, (a.x[1] + b.x[1]) / 2, 0}};
}

bool Union::is_in_mesh(const Group& group) const {
  const LatticePoint point = middle(group), end = far_from(point);
  const auto is_passed = [&](const Segment& s) {
    return side_of_facet(s.a, s.b, point) != side_of_facet(s.a, s.b, end) &&
           side_of_mesh_edge(point, end, s.a) != side_of_mesh_edge(point, end, s.b);
  };
  return std::count_if(border_.begin(), border_.end(), is_passed) % 2 == 1;
}

Union::Sides Union::sides(const Group& group) const {
  const LatticePoint &a = arranged_.point[group.vertex[0]], &b = arranged_.point[group.vertex[1]];
  const LatticePoint point = middle(group);
  const std::vector<int> here = windings(point);
  std::vector<int> other = here;
  const int side = side_of_facet(a, b, point);
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
  bool decided = false;
  const auto keep = [&](int g, bool alone) {
    const Sides wet = sides(groups_[g]);
    const std::vector<Walk> chain = alone ? std::vector<Walk>{{g, true}} : chain_through(g);
    if (!alone || !decided) arranged_.all_covered = !wet.left;
    decided = true;
    if (wet.left == wet.right) return;
    for (const Walk& walk : chain) {
      // The body lies to the left of a facet.
      const int start = groups_[walk.group].vertex[walk.forward == wet.right ? 0 : 1];
      const auto& members = groups_[walk.group].members;
      const auto member = std::find_if(members.begin(), members.end(),
                                       [&](int s) { return arranged_.list[s].vertex[0] == start; });
      if (member != members.end()) kept.push_back(*member);
    }
  };
  const auto count = static_cast<int>(groups_.size());
  for (int g = 0; g < count; ++g)
    if (visited_[g] == 0 && (border_.empty() || is_in_mesh(groups_[g]))) keep(g, false);
  // Outside of the mesh each stands for itself.
  for (int g = 0; g < count; ++g)
    if (visited_[g] == 0) keep(g, true);
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace

void unite_in_plane(Facets& facets, const Border& border) {
  Facets united;
  if (Union(facets, border).build(united)) facets = std::move(united);
}

}  // namespace seam::cutting
