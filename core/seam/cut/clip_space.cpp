// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "seam/cut/clip.hpp"

namespace seam::cutting {
namespace {

/// A cell's polyhedron with its own numbers of vertices and edges.
struct Polyhedron {
  struct LocalSide {
    std::array<int, 3> vertex, edge;
    std::array<signed char, 3> forward;
    int side;  ///< of Outline
  };
  std::vector<int> vertices, edges;  ///< of Outline, ascending
  std::vector<std::array<int, 2>> ends;
  std::vector<LocalSide> sides;
  LatticePoint low, high;
};

int place_of(const std::vector<int>& sorted, int value) {
  return static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
}

void sort_unique(std::vector<int>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

void load(const ClipInput& input, int cell, Polyhedron& p) {
  p.vertices.clear();
  p.edges.clear();
  p.ends.clear();
  p.sides.clear();
  const int first = input.outline.first_side[cell], last = input.outline.first_side[cell + 1];
  for (int s = first; s < last; ++s)
    for (int k = 0; k < 3; ++k) {
      p.vertices.push_back(input.outline.sides[s].vertex[k]);
      p.edges.push_back(input.outline.sides[s].edge[k]);
    }
  sort_unique(p.vertices);
  sort_unique(p.edges);
  for (const int e : p.edges)
    p.ends.push_back(
        {place_of(p.vertices, input.outline.edges[e][0]), place_of(p.vertices, input.outline.edges[e][1])});
  for (int s = first; s < last; ++s) {
    const Side& side = input.outline.sides[s];
    auto& local = p.sides.emplace_back();
    local.side = s;
    local.forward = side.forward;
    for (int k = 0; k < 3; ++k) {
      local.vertex[k] = place_of(p.vertices, side.vertex[k]);
      local.edge[k] = place_of(p.edges, side.edge[k]);
    }
  }
  p.low = p.high = input.vertex[p.vertices[0]];
  for (const int v : p.vertices)
    for (int i = 0; i < 3; ++i) {
      p.low.x[i] = std::min(p.low.x[i], input.vertex[v].x[i]);
      p.high.x[i] = std::max(p.high.x[i], input.vertex[v].x[i]);
    }
}

/// Six times the volume of abcd, made to agree with its exact sign: where it does not, it is mere rounding.
double volume(const Vector& a, const Vector& b, const Vector& c, const Vector& d, int sign) {
  const auto [p, q, r] = longest_opposite(a, b, c);
  return std::max(0.0, sign * dot(cross(q - p, r - p), d - p));
}

/// a / (a + b); where rounding leaves nothing of both, that of the same sizes on the lattice.
template <class OnLattice>
double ratio(double a, double b, const OnLattice& on_lattice) {
  if (a + b > 0) return a / (a + b);
  const auto [c, d] = on_lattice();
  return c + d > 0 ? c / (c + d) : 0.5;
}

/// Of segment and triangle that lie nearly in one plane rounding alone says where on the way from a to b they
/// meet, but not beyond the triangle's rim: exact signs have told that the segment passes through it.
/// @param noise how far positions may be from where the signs have them
double on_triangle(double share, const Vector& a, const Vector& b, const std::array<Vector, 3>& corner,
                   double noise) {
  const auto [p, q, r] = longest_opposite(corner[0], corner[1], corner[2]);
  const Vector normal = cross(q - p, r - p);
  double first = 0, last = 1;
  for (int k = 0; k < 3; ++k) {
    const Vector out = cross(corner[(k + 1) % 3] - corner[k], normal);
    // Along the rim itself it is the lattice that tells.
    const double blur = noise * std::sqrt(dot(out, out));
    const double at_a = dot(out, a - corner[k]) - blur, at_b = dot(out, b - corner[k]) - blur;
    if ((at_a > 0) == (at_b > 0)) continue;
    const double rim = at_a / (at_a - at_b);
    if (at_a > 0)
      first = std::max(first, rim);
    else
      last = std::min(last, rim);
  }
  return first <= last ? std::clamp(share, first, last) : 0.5 * (first + last);
}

/// Clips one facet after the other to a polyhedron. The facet's plane meets each side in at most one segment,
/// the trace; traces and the inner parts of the facet's edges, linked at their ends, bound the pieces. All
/// that is decided is decided by exact signs, so that every trace finds its continuation.
class FacetClipper {
 public:
  FacetClipper(const ClipInput& input, const Polyhedron& cell, CutCell& result)
      : input_(input), cell_(cell), result_(result), noise_(16 * input.facets.lattice.spacing()) {}

  void clip(const Facet& facet);

 private:
  static constexpr int none = -1;
  static constexpr signed char unknown = 2;
  struct Trace {
    int side;
    Vector from, to;
    int end_edge = none;                          ///< of the cell: the trace goes on behind it
    int end_facet_edge = none, end_event = none;  ///< or the facet's own edge takes over there
    bool visited = false;
  };
  /// Where an edge of the facet passes through a side.
  struct Event {
    double share;
    bool entering;
    int side;
    Vector position;
    int trace = none;  ///< that starts here, when leaving
  };

  [[nodiscard]] const LatticePoint& corner(int k) const { return input_.facets.point[facet_->vertex[k % 3]]; }
  [[nodiscard]] const Vector& place(int k) const { return input_.facets.position[facet_->vertex[k % 3]]; }
  [[nodiscard]] const LatticePoint& vertex(int v) const { return input_.vertex[cell_.vertices[v]]; }
  [[nodiscard]] const Vector& position(int v) const { return input_.outline.position[cell_.vertices[v]]; }
  [[nodiscard]] bool contains(const LatticePoint& p) const;
  int edge_side(int edge, int k);
  bool find_vertex_sides();
  void find_edge_points();
  void find_events();
  void add_event(int side, int k, int from_side);
  void find_traces();
  void link();
  void walk(int first);
  /// Follows the facet's edges from an entering event to the trace that begins where they leave the cell.
  int follow_edges(int k, int event);
  void add_piece();

  const ClipInput& input_;
  const Polyhedron& cell_;
  CutCell& result_;
  double noise_;  ///< of positions: what is flush is some steps of the lattice off them
  const Facet* facet_ = nullptr;
  std::vector<signed char> vertex_side_;               ///< [vertex]
  std::vector<std::array<signed char, 3>> edge_side_;  ///< [edge][edge of the facet]
  std::vector<int> crossing_;                          ///< [edge]: into result_.crossings
  std::vector<int> next_trace_;                        ///< [edge]: trace that starts on it
  std::array<std::vector<Event>, 3> events_;
  std::vector<Trace> traces_;
  std::vector<Vector> loop_;
};

bool FacetClipper::contains(const LatticePoint& p) const {
  for (int i = 0; i < 3; ++i)
    if (p.x[i] < cell_.low.x[i] || p.x[i] >= cell_.high.x[i]) return false;
  LatticePoint far_away = p;
  far_away.x[0] = std::int64_t{1} << 51;
  bool inside = false;
  for (const auto& s : cell_.sides) {
    const LatticePoint &a = vertex(s.vertex[0]), &b = vertex(s.vertex[1]), &c = vertex(s.vertex[2]);
    if (side_of_mesh_face(a, b, c, p) == side_of_mesh_face(a, b, c, far_away)) continue;
    const int turn = side_of_edges(a, b, p, far_away);
    if (side_of_edges(b, c, p, far_away) == turn && side_of_edges(c, a, p, far_away) == turn)
      inside = !inside;
  }
  return inside;
}

int FacetClipper::edge_side(int edge, int k) {
  signed char& value = edge_side_[edge][k];
  if (value == unknown)
    value = static_cast<signed char>(
        side_of_edges(vertex(cell_.ends[edge][0]), vertex(cell_.ends[edge][1]), corner(k), corner(k + 1)));
  return value;
}

/// @return whether the facet's plane passes through the cell
bool FacetClipper::find_vertex_sides() {
  vertex_side_.resize(cell_.vertices.size());
  bool above = false, below = false;
  for (std::size_t v = 0; v < cell_.vertices.size(); ++v) {
    vertex_side_[v] =
        static_cast<signed char>(side_of_facet(corner(0), corner(1), corner(2), vertex(static_cast<int>(v))));
    (vertex_side_[v] > 0 ? above : below) = true;
  }
  return above && below;
}

void FacetClipper::find_edge_points() {
  crossing_.assign(cell_.edges.size(), none);
  next_trace_.assign(cell_.edges.size(), none);
  edge_side_.assign(cell_.edges.size(), {unknown, unknown, unknown});
  for (int e = 0; e < static_cast<int>(cell_.edges.size()); ++e) {
    const int a = cell_.ends[e][0], b = cell_.ends[e][1];
    if (vertex_side_[a] == vertex_side_[b]) continue;
    const int turn = edge_side(e, 0);
    if (edge_side(e, 1) != turn || edge_side(e, 2) != turn) continue;
    const double at = ratio(volume(place(0), place(1), place(2), position(a), vertex_side_[a]),
                            volume(place(0), place(1), place(2), position(b), vertex_side_[b]), [&] {
                              return std::pair(std::abs(size(corner(0), corner(1), corner(2), vertex(a))),
                                               std::abs(size(corner(0), corner(1), corner(2), vertex(b))));
                            });
    const double share = on_triangle(at, position(a), position(b), {place(0), place(1), place(2)}, noise_);
    crossing_[e] = static_cast<int>(result_.crossings.size());
    result_.crossings.push_back({facet_->body, cell_.edges[e], vertex_side_[a], share,
                                 position(a) + share * (position(b) - position(a))});
  }
}

void FacetClipper::add_event(int side, int k, int from_side) {
  // The cell behind the side turns it round: both work with its vertices in one order, hence to the bit.
  std::array<int, 3> v = cell_.sides[side].vertex;
  int turn = from_side;
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)})
    if (vertex(v[j]) < vertex(v[i])) {
      std::swap(v[i], v[j]);
      turn = -turn;
    }
  const Vector &a = position(v[0]), &b = position(v[1]), &c = position(v[2]);
  const double at = ratio(volume(a, b, c, place(k), turn), volume(a, b, c, place(k + 1), -turn), [&] {
    const LatticePoint &p = vertex(v[0]), &q = vertex(v[1]), &r = vertex(v[2]);
    return std::pair(std::abs(size(p, q, r, corner(k))), std::abs(size(p, q, r, corner(k + 1))));
  });
  const double share = on_triangle(at, place(k), place(k + 1), {a, b, c}, noise_);
  events_[k].push_back({share, from_side > 0, side, place(k) + share * (place(k + 1) - place(k))});
}

void FacetClipper::find_events() {
  for (auto& events : events_) events.clear();
  for (int t = 0; t < static_cast<int>(cell_.sides.size()); ++t) {
    const auto& s = cell_.sides[t];
    if (vertex_side_[s.vertex[0]] == vertex_side_[s.vertex[1]] &&
        vertex_side_[s.vertex[0]] == vertex_side_[s.vertex[2]])
      continue;
    std::array<int, 3> side{};
    for (int k = 0; k < 3; ++k)
      side[k] = side_of_mesh_face(vertex(s.vertex[0]), vertex(s.vertex[1]), vertex(s.vertex[2]), corner(k));
    for (int k = 0; k < 3; ++k) {
      if (side[k] == side[(k + 1) % 3]) continue;
      const int turn = s.forward[0] * edge_side(s.edge[0], k);
      if (s.forward[1] * edge_side(s.edge[1], k) == turn && s.forward[2] * edge_side(s.edge[2], k) == turn)
        add_event(t, k, side[k]);
    }
  }
  for (int k = 0; k < 3; ++k) {
    auto& events = events_[k];
    if (events.empty()) continue;
    std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.share < b.share; });
    // Passages through one point are the only ones whose order rounding can reverse.
    bool inside = contains(corner(k));
    for (std::size_t i = 0; i < events.size(); inside = !inside, ++i) {
      const auto next = std::find_if(events.begin() + static_cast<std::ptrdiff_t>(i), events.end(),
                                     [&](const Event& e) { return e.entering != inside; });
      if (next != events.end()) std::swap(events[i], *next);
    }
  }
}

/// Seen from outside the cell, a trace has the body on its right: it runs from the edge on which a way round
/// the side goes into the body to the one on which it comes out.
void FacetClipper::find_traces() {
  traces_.clear();
  for (int t = 0; t < static_cast<int>(cell_.sides.size()); ++t) {
    const auto& s = cell_.sides[t];
    Trace trace{t, {}, {}};
    int start_edge = none;
    bool met = false;
    for (int i = 0; i < 3; ++i) {
      const int e = s.edge[i];
      if (crossing_[e] == none) continue;
      met = true;
      const Vector& x = result_.crossings[crossing_[e]].position;
      if (vertex_side_[s.vertex[i]] > 0) {
        start_edge = e;
        trace.from = x;
      } else {
        trace.end_edge = e;
        trace.to = x;
      }
    }
    for (int k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < events_[k].size(); ++i) {
        Event& event = events_[k][i];
        if (event.side != t) continue;
        met = true;
        if (event.entering) {
          trace.end_facet_edge = k;
          trace.end_event = static_cast<int>(i);
          trace.to = event.position;
        } else {
          event.trace = static_cast<int>(traces_.size());
          trace.from = event.position;
        }
      }
    if (!met) continue;
    if (start_edge != none) next_trace_[start_edge] = static_cast<int>(traces_.size());
    traces_.push_back(trace);
  }
}

int FacetClipper::follow_edges(int k, int event) {
  loop_.push_back(events_[k][event].position);
  // An entering event is followed by a leaving one on the same edge, or the edge's end is inside.
  for (++event;; ++k, event = 0) {
    k %= 3;
    if (event < static_cast<int>(events_[k].size())) return events_[k][event].trace;
    loop_.push_back(place(k + 1));
  }
}

void FacetClipper::walk(int first) {
  loop_.clear();
  for (int t = first; !traces_[t].visited;) {
    Trace& trace = traces_[t];
    trace.visited = true;
    loop_.push_back(trace.from);
    t = trace.end_edge != none ? next_trace_[trace.end_edge]
                               : follow_edges(trace.end_facet_edge, trace.end_event);
  }
  add_piece();
}

void FacetClipper::add_piece() {
  result_.pieces.push_back({facet_->body, facet_->facet, static_cast<int>(result_.points.size()),
                            static_cast<int>(loop_.size()), facet_->normal});
  result_.points.insert(result_.points.end(), loop_.begin(), loop_.end());
}

void FacetClipper::link() {
  for (const Trace& t : traces_) result_.traces.push_back({cell_.sides[t.side].side, t.from, t.to});
  for (int t = 0; t < static_cast<int>(traces_.size()); ++t)
    if (!traces_[t].visited) walk(t);
  const bool edges_miss =
      std::all_of(events_.begin(), events_.end(), [](const auto& e) { return e.empty(); });
  if (edges_miss && contains(corner(0))) {
    loop_ = {place(0), place(1), place(2)};
    add_piece();
  }
}

void FacetClipper::clip(const Facet& facet) {
  facet_ = &facet;
  if (!find_vertex_sides()) return;
  find_edge_points();
  find_events();
  find_traces();
  link();
}

/// Signed triangles with the side's vertex 0, between it and the parts of the boundary of the wet part:
/// traces and the wet part of the edge opposite. The other two edges pass through vertex 0 and add nothing.
class SideFan {
 public:
  SideFan(const Outline& outline, const Side& side, CutCell& cell) : side_(side), cell_(cell) {
    for (int k = 0; k < 3; ++k) corner_[k] = outline.position[side.vertex[k]];
    normal_ = side_normal(outline, side);
  }

  void add(const std::vector<int>& coverage, int s) {
    const int wet = 1 - coverage[side_.vertex[1]];
    if (wet != 0) triangle(corner_[1], corner_[2], wet);
    for (const Crossing& x : cell_.crossings)
      if (x.place == side_.edge[1]) triangle(x.position, corner_[2], -x.step * side_.forward[1]);
    for (const Trace& t : cell_.traces)
      if (t.side == s) triangle(t.from, t.to, 1);
  }

 private:
  void triangle(const Vector& a, const Vector& b, int sign) {
    const double area = 0.5 * sign * dot(cross(a - corner_[0], b - corner_[0]), normal_);
    if (area != 0)
      cell_.wet.push_back({side_.face, normal_, {corner_[0], a, b}, static_cast<double>(sign), area});
  }

  const Side& side_;
  CutCell& cell_;
  std::array<Vector, 3> corner_{};
  Vector normal_{};
};

}  // namespace

void clip_triangles(const ClipInput& input, std::span<const int> facets, CutCell& cell) {
  static thread_local Polyhedron polyhedron;
  load(input, cell.cell, polyhedron);
  FacetClipper clipper(input, polyhedron, cell);
  for (const int f : facets) clipper.clip(input.facets.list[f]);
}

void find_wet_faces(const ClipInput& input, const std::vector<int>& coverage, CutCell& cell) {
  for (int s = input.outline.first_side[cell.cell]; s < input.outline.first_side[cell.cell + 1]; ++s)
    SideFan(input.outline, input.outline.sides[s], cell).add(coverage, s);
}

}  // namespace seam::cutting
