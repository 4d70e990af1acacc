// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/unite_in_cell.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "seam/cut/convex.hpp"
#include "seam/cut/slivers.hpp"

namespace seam::cutting {
namespace {

constexpr int inner = -1;  ///< origin of faces between the parts of a cell that is not convex

/// A facet's piece, or a part of it.
struct Fragment {
  Polygon corner;
  int piece;  ///< of the cell
};

/// Divides a convex part of a cell along the planes of fragments (a binary space partition). In a part
/// without fragments nothing changes any more; it lies on the side of a body that its last division along one
/// of that body's fragments tells.
struct Node {
  Plane plane;
  std::vector<Fragment> in_plane;
  std::unique_ptr<Node> front, back;
  // Leaves only:
  Convex part;
  bool wet = false;
};

class CellUnion {
 public:
  CellUnion(const ClipInput& input, const std::vector<std::vector<int>>& windings, CutCell& cell)
      : input_(input), windings_(windings), cell_(cell) {
    cell_volume_ = input.outline.volume(cell.cell);
    resolution_ = 2e-14 * std::cbrt(cell_volume_);
    centre_ = input.outline.centre(cell.cell);
  }

  void run(bool convex) {
    const Outline& outline = input_.outline;
    find_overlaps();
    Convex whole;
    for (int s = outline.first_side[cell_.cell]; s < outline.first_side[cell_.cell + 1]; ++s) {
      const auto& v = outline.sides[s].vertex;
      whole.faces.push_back({{outline.position[v[0]], outline.position[v[1]], outline.position[v[2]]}, s});
    }
    reference_ = outline.sides[outline.first_side[cell_.cell]].vertex[0];
    if (convex) {
      add_part(whole);
    } else {
      for (const Convex::Face& base : whole.faces) add_part(cone(base, centre_));
    }
    cell_.united = true;
    cell_.wet = std::move(wet_);
    cell_.pieces = std::move(pieces_);
    cell_.points = std::move(points_);
  }

 private:
  /// Of each body: whether a part of the cell lies in it, where a division has told.
  enum class Lies : char { unknown, outside, inside };
  using LiesInBodies = std::vector<Lies>;

  static Convex cone(const Convex::Face& base, const Vector& apex) {
    Convex result{{base}};
    for (int k = 0; k < 3; ++k)
      result.faces.push_back({{base.corner[(k + 1) % 3], base.corner[k], apex}, inner});
    return result;
  }

  void find_overlaps();
  /// What lies on the cell's border by rounding is clearly inside afterwards, and all keeps together.
  [[nodiscard]] Vector inward(const Vector& x) const { return x - 5 * 2e-14 * (x - centre_); }
  [[nodiscard]] bool is_wide(const Polygon& polygon) const;
  void add_part(const Convex& part);
  std::unique_ptr<Node> divide(const Convex& part, std::vector<Fragment> fragments,
                               const LiesInBodies& places);
  /// Of the cell's size: in the middle of a thicker part the lattice tells what is inside; a thinner one lies
  /// where its divisions say.
  static constexpr double thick = 1e-11;
  [[nodiscard]] double thickness(const Convex& part) const;
  [[nodiscard]] bool is_wet_part(const Convex& part, const LiesInBodies& places) const;
  std::unique_ptr<Node> divide_at(const Node& node, const Convex& part, std::vector<Fragment> fragments,
                                  const LiesInBodies& before, bool in_front,
                                  const std::vector<Fragment>& walls);
  std::unique_ptr<Node> divide_at_walls(const Node& node, const Convex& part, std::vector<Fragment> fragments,
                                        const LiesInBodies& covered, const LiesInBodies& uncovered,
                                        const std::vector<Fragment>& walls, std::size_t wall);
  std::unique_ptr<Node> divide_layer(const Vector& normal, const Convex& part,
                                     std::vector<Fragment> fragments, const std::vector<Polygon>& covers,
                                     std::size_t cover, std::size_t edge, const LiesInBodies& covered,
                                     const LiesInBodies& uncovered);
  [[nodiscard]] LiesInBodies places_after(const Node& node, const std::vector<Fragment>& fragments,
                                          LiesInBodies places, bool in_front) const;
  void collect(const Node& node, std::vector<const Node*>& ancestors);
  void add_leaf(const Node& leaf, const std::vector<const Node*>& ancestors);
  void add_interface(const Polygon& polygon, const Node& node);
  void add_piece(const Polygon& polygon, const FacetPiece& source, const Vector& into, double scale);
  static void against_body(const Node& node, const Polygon& polygon, std::vector<Polygon>& parts);
  [[nodiscard]] Plane plane_of(const Fragment& fragment) const;

  const ClipInput& input_;
  const std::vector<std::vector<int>>& windings_;
  CutCell& cell_;
  double cell_volume_, resolution_;
  Vector centre_;
  int reference_ = 0;                  ///< a vertex of the cell
  std::vector<bool> overlaps_itself_;  ///< [body]
  std::vector<const Node*> nodes_;     ///< those that divide, in order
  std::vector<SideSimplex> wet_;
  std::vector<FacetPiece> pieces_;
  std::vector<Vector> points_;
};

/// Origins of faces from -2 downwards are nodes.
int node_origin(std::size_t index) { return -2 - static_cast<int>(index); }

Plane CellUnion::plane_of(const Fragment& fragment) const {
  const Vector normal = -1 * cell_.pieces[fragment.piece].normal;  // out of the body
  return {normal, dot(normal, fragment.corner[0])};
}

/// Strips as narrow as what inward() moves would divide the cell where they no longer are.
bool CellUnion::is_wide(const Polygon& polygon) const {
  if (polygon.empty()) return false;
  double longest = 0;
  for (const Vector& x : polygon) longest = std::max(longest, dot(x - polygon[0], x - polygon[0]));
  const Vector area = vector_area(polygon);
  return dot(area, area) > longest * std::pow(25 * resolution_, 2);
}

void CellUnion::add_part(const Convex& part) {
  nodes_.clear();
  std::vector<Fragment> fragments;
  for (std::size_t k = 0; k < cell_.pieces.size(); ++k) {
    const FacetPiece& p = cell_.pieces[k];
    Fragment fragment{{}, static_cast<int>(k)};
    for (int i = 0; i < p.count; ++i) fragment.corner.push_back(inward(cell_.points[p.first + i]));
    Polygon front, back;
    for (const Convex::Face& face : part.faces) {
      const Vector out = vector_area(face.corner);
      split(fragment.corner, {out, dot(out, face.corner[0])}, front, back);
      fragment.corner = back;
    }
    if (is_wide(fragment.corner)) fragments.push_back(std::move(fragment));
  }
  const std::unique_ptr<Node> root =
      divide(part, std::move(fragments), LiesInBodies(windings_.size(), Lies::unknown));
  std::vector<const Node*> ancestors;
  collect(*root, ancestors);
}

std::unique_ptr<Node> CellUnion::divide(const Convex& part, std::vector<Fragment> fragments,
                                        const LiesInBodies& places) {
  auto node = std::make_unique<Node>();
  const auto area = [](const Fragment& f) {
    const Vector a = vector_area(f.corner);
    return dot(a, a);
  };
  while (!fragments.empty()) {
    const auto chosen =
        std::max_element(fragments.begin(), fragments.end(),
                         [&](const Fragment& a, const Fragment& b) { return area(a) < area(b); });
    const Plane plane = plane_of(*chosen);
    Convex front, back;
    split(part, plane, node_origin(nodes_.size()), front, back);
    if (front.faces.empty() || back.faces.empty()) {
      fragments.erase(chosen);  // on the border of the part by rounding: it divides nothing
      continue;
    }
    nodes_.push_back(node.get());
    node->plane = plane;
    std::vector<Fragment> before, behind;
    std::vector<Fragment> on_front, on_back;  // those that end on the plane, along an edge of theirs
    const auto number = chosen - fragments.begin();
    for (Fragment& f : fragments) {
      // The chosen one lies in its own plane, whatever rounding has made of a narrow one: so this comes to an
      // end.
      if (&f == &fragments[number]) {
        node->in_plane.push_back(std::move(f));
        continue;
      }
      double low = 0, high = 0;
      for (const Vector& x : f.corner) {
        low = std::min(low, plane.height(x));
        high = std::max(high, plane.height(x));
      }
      if (high <= resolution_ && low >= -resolution_) {
        // A strip so narrow that it lies in the plane only by that is too small to matter.
        if (std::abs(dot(cell_.pieces[f.piece].normal, plane.normal)) > 0.5)
          node->in_plane.push_back(std::move(f));
        continue;
      }
      const auto touching = std::count_if(f.corner.begin(), f.corner.end(), [&](const Vector& x) {
        return std::abs(plane.height(x)) <= resolution_;
      });
      if (low > -resolution_ && touching > 1) on_front.push_back(f);
      if (high < resolution_ && touching > 1) on_back.push_back(f);
      Fragment above{{}, f.piece}, below{{}, f.piece};
      split(f.corner, plane, above.corner, below.corner);
      if (high > resolution_ && !above.corner.empty()) before.push_back(std::move(above));
      if (low < -resolution_ && !below.corner.empty()) behind.push_back(std::move(below));
    }
    node->front = divide_at(*node, front, std::move(before), places, true, on_back);
    node->back = divide_at(*node, back, std::move(behind), places, false, on_front);
    return node;
  }
  node->part = part;
  node->wet = is_wet_part(part, places);
  return node;
}

std::unique_ptr<Node> CellUnion::divide_at(const Node& node, const Convex& part,
                                           std::vector<Fragment> fragments, const LiesInBodies& before,
                                           bool in_front, const std::vector<Fragment>& walls) {
  const LiesInBodies places = places_after(node, fragments, before, in_front);
  if (volume(part) > smallest_part * cell_volume_) return divide(part, std::move(fragments), places);
  // A facet that ends on this layer at the cell's border covers only a part of it, and the facets round the
  // corner are too narrow here to tell which.
  LiesInBodies uncovered = places;
  for (const Fragment& f : node.in_plane) uncovered[cell_.pieces[f.piece].body] = Lies::unknown;
  return divide_at_walls(node, part, std::move(fragments), places, uncovered, walls, 0);
}

/// Divides a thin layer along the fragments that reach it from beyond the plane, of other bodies, too: they
/// go on through it and are too narrow there to be fragments themselves.
std::unique_ptr<Node> CellUnion::divide_at_walls(const Node& node, const Convex& part,
                                                 std::vector<Fragment> fragments, const LiesInBodies& covered,
                                                 const LiesInBodies& uncovered,
                                                 const std::vector<Fragment>& walls, std::size_t wall) {
  if (wall == walls.size()) {
    std::vector<Polygon> covers;
    for (const Fragment& f : node.in_plane) covers.push_back(f.corner);
    return divide_layer(node.plane.normal, part, std::move(fragments), covers, 0, 0, covered, uncovered);
  }
  const Plane plane = plane_of(walls[wall]);
  const int body = cell_.pieces[walls[wall].piece].body;
  const bool has_cover = std::any_of(node.in_plane.begin(), node.in_plane.end(),
                                     [&](const Fragment& f) { return cell_.pieces[f.piece].body == body; });
  double low = 0, high = 0;
  for (const Convex::Face& face : part.faces)
    for (const Vector& x : face.corner) {
      low = std::min(low, plane.height(x));
      high = std::max(high, plane.height(x));
    }
  // One on the layer's own rim divides nothing.
  if (has_cover || low > -25 * resolution_ || high < 25 * resolution_)
    return divide_at_walls(node, part, std::move(fragments), covered, uncovered, walls, wall + 1);
  Convex front, back;
  split(part, plane, node_origin(nodes_.size()), front, back);
  auto result = std::make_unique<Node>();
  nodes_.push_back(result.get());
  result->plane = plane;
  result->in_plane = {walls[wall]};
  std::vector<Fragment> before, behind;
  for (Fragment& f : fragments) {
    Fragment above{{}, f.piece}, below{{}, f.piece};
    split(f.corner, plane, above.corner, below.corner);
    if (is_wide(above.corner)) before.push_back(std::move(above));
    if (is_wide(below.corner)) behind.push_back(std::move(below));
  }
  result->front = divide_at_walls(node, front, std::move(before), covered, uncovered, walls, wall + 1);
  result->back = divide_at_walls(node, back, std::move(behind), covered, uncovered, walls, wall + 1);
  return result;
}

/// Divides a thin layer along the edges of the polygons that cover it.
std::unique_ptr<Node> CellUnion::divide_layer(const Vector& normal, const Convex& part,
                                              std::vector<Fragment> fragments,
                                              const std::vector<Polygon>& covers, std::size_t cover,
                                              std::size_t edge, const LiesInBodies& covered,
                                              const LiesInBodies& uncovered) {
  if (cover == covers.size()) return divide(part, std::move(fragments), uncovered);
  const Polygon& polygon = covers[cover];
  if (edge == polygon.size()) return divide(part, std::move(fragments), covered);
  const Vector &a = polygon[edge], &b = polygon[(edge + 1) % polygon.size()];
  Convex front, back;
  if (dot(b - a, b - a) > resolution_ * resolution_) {
    // Polygons run either way round the plane's normal; the outside is where their middle is not.
    Vector out = cross(b - a, normal);
    out = 1 / std::sqrt(dot(out, out)) * out;
    Vector middle{};
    for (const Vector& x : polygon) middle = middle + 1.0 / static_cast<double>(polygon.size()) * x;
    if (dot(out, middle - a) > 0) out = -1 * out;
    // Edges on the layer's own rim divide nothing.
    const Plane plane{out, dot(out, a) + 25 * resolution_};
    split(part, plane, inner, front, back);
    if (!front.faces.empty() && !back.faces.empty()) {
      auto node = std::make_unique<Node>();
      node->plane = plane;
      std::vector<Fragment> outer, rest;
      for (Fragment& f : fragments) {
        Fragment above{{}, f.piece}, below{{}, f.piece};
        split(f.corner, plane, above.corner, below.corner);
        if (is_wide(above.corner)) outer.push_back(std::move(above));
        if (is_wide(below.corner)) rest.push_back(std::move(below));
      }
      node->front = divide_layer(normal, front, std::move(outer), covers, cover + 1, 0, covered, uncovered);
      node->back = divide_layer(normal, back, std::move(rest), covers, cover, edge + 1, covered, uncovered);
      return node;
    }
    if (back.faces.empty())
      return divide_layer(normal, part, std::move(fragments), covers, cover + 1, 0, covered, uncovered);
  }
  return divide_layer(normal, part, std::move(fragments), covers, cover, edge + 1, covered, uncovered);
}

/// Next to a division along a body's fragment, and with no other fragment of that body, a part lies wholly on
/// that fragment's side. A body so thin that both of its sides lie in the division is on neither.
CellUnion::LiesInBodies CellUnion::places_after(const Node& node, const std::vector<Fragment>& fragments,
                                                LiesInBodies places, bool in_front) const {
  const auto place = [&](const Fragment& f) {
    const bool before_it = (dot(cell_.pieces[f.piece].normal, node.plane.normal) < 0) == in_front;
    return before_it ? Lies::outside : Lies::inside;
  };
  const auto body = [&](const Fragment& f) { return cell_.pieces[f.piece].body; };
  for (const Fragment& f : node.in_plane) places[body(f)] = place(f);
  for (const Fragment& f : node.in_plane)
    if (places[body(f)] != place(f)) places[body(f)] = Lies::unknown;
  for (const Fragment& f : fragments) places[cell_.pieces[f.piece].body] = Lies::unknown;
  return places;
}

/// Of a convex part, in sizes of the cell.
double CellUnion::thickness(const Convex& part) const {
  double area = 0;
  for (const Convex::Face& face : part.faces) {
    const Vector a = vector_area(face.corner);
    area += std::sqrt(dot(a, a));
  }
  return area > 0 ? 2 * volume(part) / area / std::cbrt(cell_volume_) : 0;
}

bool CellUnion::is_wet_part(const Convex& part, const LiesInBodies& places) const {
  const LatticePoint middle = input_.facets.lattice.round(centre(part));
  const bool is_thin = thickness(part) < thick;
  for (int body = 0; body < static_cast<int>(windings_.size()); ++body) {
    if (is_thin && places[body] != Lies::unknown && !overlaps_itself_[body]) {
      if (places[body] == Lies::inside) return false;
      continue;
    }
    int winding = windings_[body][reference_];
    for (const int f : cell_.facets)
      if (input_.facets.list[f].body == body)
        winding += crossing(input_.facets, input_.facets.list[f], input_.vertex[reference_], middle);
    if (winding > 0) return false;
  }
  return true;
}

/// Where a winding number other than 0 and 1 occurs, the last division does not tell the side.
void CellUnion::find_overlaps() {
  const Outline& outline = input_.outline;
  overlaps_itself_.assign(windings_.size(), false);
  for (std::size_t b = 0; b < windings_.size(); ++b)
    for (int s = outline.first_side[cell_.cell]; s < outline.first_side[cell_.cell + 1]; ++s)
      for (const int v : outline.sides[s].vertex)
        if (windings_[b][v] < 0 || windings_[b][v] > 1) overlaps_itself_[b] = true;
}

void CellUnion::collect(const Node& node, std::vector<const Node*>& ancestors) {
  if (!node.front) {
    if (node.wet) add_leaf(node, ancestors);
    return;
  }
  ancestors.push_back(&node);
  collect(*node.front, ancestors);
  collect(*node.back, ancestors);
  ancestors.pop_back();
}

/// The parts of a polygon behind which a node's leaves belong to a body.
void CellUnion::against_body(const Node& node, const Polygon& polygon, std::vector<Polygon>& parts) {
  if (polygon.empty()) return;
  if (!node.front) {
    if (!node.wet) parts.push_back(polygon);
    return;
  }
  Polygon front, back;
  split(polygon, node.plane, front, back);
  against_body(*node.front, front, parts);
  against_body(*node.back, back, parts);
}

void CellUnion::add_leaf(const Node& leaf, const std::vector<const Node*>& ancestors) {
  const Vector middle = centre(leaf.part);
  for (const Convex::Face& face : leaf.part.faces) {
    if (face.origin == inner) continue;
    if (face.origin >= 0) {
      const Side& side = input_.outline.sides[face.origin];
      append_wet(side.face, side_normal(input_.outline, side), face.corner, wet_);
      continue;
    }
    const Node* node = nodes_[-2 - face.origin];
    if (std::find(ancestors.begin(), ancestors.end(), node) == ancestors.end()) continue;
    const Node& behind = node->plane.height(middle) > 0 ? *node->back : *node->front;
    std::vector<Polygon> parts;
    against_body(behind, face.corner, parts);
    for (const Polygon& p : parts) add_interface(p, *node);
  }
}

void CellUnion::add_interface(const Polygon& polygon, const Node& node) {
  const Vector area = vector_area(polygon);
  const double whole = std::sqrt(dot(area, area));
  if (whole == 0) return;
  const Vector out = 1 / whole * area;
  const Vector into = dot(node.plane.normal, out) > 0 ? node.plane.normal : -1 * node.plane.normal;
  double covered = 0, most = 0;
  int largest = node.in_plane.front().piece;
  std::vector<std::pair<Polygon, int>> parts;
  for (const Fragment& f : node.in_plane) {
    const Vector normal = cell_.pieces[f.piece].normal;
    if (dot(normal, out) <= 0) continue;  // turned away from the wet part
    const Polygon common = common_part(polygon, f.corner, -1 * normal, resolution_);
    const double share = dot(vector_area(common), out);
    if (share <= 1e-14 * whole) continue;
    covered += share;
    if (share > most) {
      most = share;
      largest = f.piece;
    }
    parts.emplace_back(common, f.piece);
  }
  // Coinciding facets of two bodies share what they cover. Of next to nothing rounding is the larger part.
  if (covered < 0.5 * whole)
    add_piece(polygon, cell_.pieces[largest], into, 1.0);
  else
    for (const auto& [part, piece] : parts) add_piece(part, cell_.pieces[piece], into, whole / covered);
}

/// @param into the body: narrow facets in the plane of a wide one may point elsewhere
void CellUnion::add_piece(const Polygon& polygon, const FacetPiece& source, const Vector& into,
                          double scale) {
  FacetPiece piece = source;
  piece.normal = into;
  piece.first = static_cast<int>(points_.size());
  piece.count = static_cast<int>(polygon.size());
  piece.scale = scale;
  // Pieces are oriented as facets are, out of the body.
  points_.insert(points_.end(), polygon.rbegin(), polygon.rend());
  pieces_.push_back(piece);
}

}  // namespace

void unite_in_cell(const ClipInput& input, const std::vector<std::vector<int>>& windings, bool convex,
                   CutCell& cell) {
  CellUnion(input, windings, cell).run(convex);
}

}  // namespace seam::cutting
