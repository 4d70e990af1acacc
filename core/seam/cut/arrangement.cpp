// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/arrangement.hpp"

#include <algorithm>
#include <cmath>

namespace seam::cutting {
namespace {

struct Bounds {
  std::int64_t low[2], high[2];
};

Bounds bounds(const Segment& s) {
  Bounds b{};
  for (int i = 0; i < 2; ++i) {
    b.low[i] = std::min(s.a.x[i], s.b.x[i]);
    b.high[i] = std::max(s.a.x[i], s.b.x[i]);
  }
  return b;
}

/// A point known to be on the line of the segment lies between its ends.
bool strictly_inside(const Segment& s, const LatticePoint& p) {
  if (p == s.a || p == s.b) return false;
  const Bounds b = bounds(s);
  for (int i = 0; i < 2; ++i)
    if (p.x[i] < b.low[i] || p.x[i] > b.high[i]) return false;
  return true;
}

/// The lattice's even point next to where two segments cross.
LatticePoint meeting(const Segment& s, const Segment& t) {
  const auto difference = [](const LatticePoint& p, const LatticePoint& q, int i) {
    return static_cast<long double>(p.x[i] - q.x[i]);
  };
  const auto area = [&](const LatticePoint& p, const LatticePoint& q, const LatticePoint& r) {
    return difference(q, p, 0) * difference(r, p, 1) - difference(q, p, 1) * difference(r, p, 0);
  };
  const long double from = area(t.a, t.b, s.a), to = area(t.a, t.b, s.b), share = from / (from - to);
  const Bounds bs = bounds(s), bt = bounds(t);
  LatticePoint p;
  for (int i = 0; i < 2; ++i) {
    p.x[i] = s.a.x[i] + 2 * std::llround(share * difference(s.b, s.a, i) / 2);
    // Rounding must not leave the segments' boxes, or splitting would not come to an end.
    p.x[i] = std::clamp(p.x[i], std::max(bs.low[i], bt.low[i]), std::min(bs.high[i], bt.high[i]));
  }
  return p;
}

/// Notes where two segments must be split.
void meet(const Segment& s, const Segment& t, std::vector<LatticePoint>& on_s,
          std::vector<LatticePoint>& on_t) {
  const int sa = orientation(t.a, t.b, s.a), sb = orientation(t.a, t.b, s.b);
  const int ta = orientation(s.a, s.b, t.a), tb = orientation(s.a, s.b, t.b);
  if (sa * sb > 0 || ta * tb > 0) return;
  if (sa * sb < 0 && ta * tb < 0) {
    const LatticePoint p = meeting(s, t);
    if (p != s.a && p != s.b) on_s.push_back(p);
    if (p != t.a && p != t.b) on_t.push_back(p);
    return;
  }
  if (sa == 0 && strictly_inside(t, s.a)) on_t.push_back(s.a);
  if (sb == 0 && strictly_inside(t, s.b)) on_t.push_back(s.b);
  if (ta == 0 && strictly_inside(s, t.a)) on_s.push_back(t.a);
  if (tb == 0 && strictly_inside(s, t.b)) on_s.push_back(t.b);
}

/// Calls visit(i, j) for pairs whose boxes meet, of which at least one is new.
template <class Visit>
void visit_pairs(const std::vector<Segment>& segments, const std::vector<char>& is_new, const Visit& visit) {
  std::vector<Bounds> box;
  Bounds all{{INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN}};
  for (const Segment& s : segments) {
    const Bounds& b = box.emplace_back(bounds(s));
    for (int i = 0; i < 2; ++i) {
      all.low[i] = std::min(all.low[i], b.low[i]);
      all.high[i] = std::max(all.high[i], b.high[i]);
    }
  }
  const int along = all.high[0] - all.low[0] >= all.high[1] - all.low[1] ? 0 : 1;
  std::vector<int> order(segments.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
  std::sort(order.begin(), order.end(), [&](int i, int j) { return box[i].low[along] < box[j].low[along]; });
  std::vector<int> active;
  for (const int i : order) {
    std::erase_if(active, [&](int j) { return box[j].high[along] < box[i].low[along]; });
    for (const int j : active)
      if ((is_new[i] != 0 || is_new[j] != 0) && box[i].low[1 - along] <= box[j].high[1 - along] &&
          box[j].low[1 - along] <= box[i].high[1 - along])
        visit(i, j);
    active.push_back(i);
  }
}

void replace(const Segment& s, std::vector<LatticePoint>& points, std::vector<Segment>& out) {
  const int along = std::abs(s.b.x[0] - s.a.x[0]) >= std::abs(s.b.x[1] - s.a.x[1]) ? 0 : 1;
  const bool ascending = s.b.x[along] > s.a.x[along];
  std::sort(points.begin(), points.end(), [&](const LatticePoint& p, const LatticePoint& q) {
    return ascending ? p.x[along] < q.x[along] : p.x[along] > q.x[along];
  });
  points.push_back(s.b);
  LatticePoint from = s.a;
  for (const LatticePoint& p : points) {
    if (p == from) continue;
    out.push_back({from, p, s.facet});
    from = p;
  }
}

}  // namespace

bool split_at_meetings(std::vector<Segment>& segments) {
  if (segments.empty()) return false;
  bool any = false;
  std::vector<char> is_new(segments.size(), 1);
  // A split moves a part by less than the lattice's spacing, which can create a further meeting, but no more
  // than a few in a row.
  for (int round = 0; round < 100; ++round) {
    std::vector<std::vector<LatticePoint>> points(segments.size());
    visit_pairs(segments, is_new,
                [&](int i, int j) { meet(segments[i], segments[j], points[i], points[j]); });
    std::vector<Segment> next;
    std::vector<char> next_is_new;
    bool split = false;
    for (std::size_t k = 0; k < segments.size(); ++k) {
      if (points[k].empty())
        next.push_back(segments[k]);
      else
        replace(segments[k], points[k], next);
      next_is_new.resize(next.size(), points[k].empty() ? 0 : 1);
      split = split || !points[k].empty();
    }
    segments = std::move(next);
    is_new = std::move(next_is_new);
    if (!split) break;
    any = true;
  }
  return any;
}

}  // namespace seam::cutting
