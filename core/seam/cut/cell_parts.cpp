// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/cell_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "seam/base/disjoint_sets.hpp"
#include "seam/cut/slivers.hpp"
#include "seam/cut/wet_leaves.hpp"

namespace seam::cutting {
namespace {

/// Of a length, an area or a volume of the cell's size: less is rounding.
constexpr double negligible = 1e-12;

/// Which part the pieces and the wet faces of a cell belong to.
struct Assignment {
  int count = 0;
  std::vector<int> piece;        ///< [piece], -1 unknown
  std::vector<SideSimplex> wet;  ///< signed parts of the cell's sides ...
  std::vector<int> wet_owner;    ///< ... and whose they are
};

double length(const Vector& a) { return std::sqrt(dot(a, a)); }

/// A directed part of the boundary of a plane cell's wet part, which lies on its left.
struct Stretch {
  Vector from, to;
  bool wet;
};

/// Whether a closed chain of stretches goes round a point: by a ray along the x axis.
bool encloses(const std::vector<Stretch>& chain, const Vector& x) {
  bool inside = false;
  for (const Stretch& s : chain) {
    if ((s.from[1] > x[1]) == (s.to[1] > x[1])) continue;
    const double share = (x[1] - s.from[1]) / (s.to[1] - s.from[1]);
    if (s.from[0] + share * (s.to[0] - s.from[0]) > x[0]) inside = !inside;
  }
  return inside;
}

/// In the plane: chains of pieces and wet sides that share end points. Those with a wet side are the
/// parts, however thin; the others are holes in them.
Assignment chains(const CutCell& cell, double size) {
  std::vector<Stretch> stretches;
  std::vector<int> index;  // of the piece, or of the wet side behind all pieces
  const int pieces = static_cast<int>(cell.pieces.size());
  for (int k = 0; k < pieces; ++k) {
    const FacetPiece& p = cell.pieces[k];
    if (p.handed_over) continue;
    stretches.push_back({cell.points[p.first + 1], cell.points[p.first], false});
    index.push_back(k);
  }
  for (std::size_t w = 0; w < cell.wet.size(); ++w) {
    stretches.push_back({cell.wet[w].corner[0], cell.wet[w].corner[1], true});
    index.push_back(pieces + static_cast<int>(w));
  }
  const int n = static_cast<int>(stretches.size());
  DisjointSets sets(n);
  std::map<Vector, int> at;
  for (int k = 0; k < n; ++k)
    for (const Vector& x : {stretches[k].from, stretches[k].to})
      if (const auto [found, is_new] = at.emplace(x, k); !is_new) sets.unite(k, found->second);
  std::map<int, std::vector<Stretch>> chain;
  std::map<int, double> wet;
  for (int k = 0; k < n; ++k) {
    const int root = sets.root(k);
    chain[root].push_back(stretches[k]);
    wet[root] += stretches[k].wet ? length(stretches[k].to - stretches[k].from) : 0;
  }
  Assignment result;
  std::map<int, int> owner;  // of a chain
  std::vector<int> outer;
  for (const auto& [root, stretch] : chain)
    if (wet[root] > negligible * size) {
      owner[root] = result.count++;
      outer.push_back(root);
    }
  for (const auto& [root, stretch] : chain)
    if (!owner.contains(root))
      for (int k = 0; k < result.count && !owner.contains(root); ++k)
        if (encloses(chain[outer[k]], stretch.front().from)) owner[root] = k;
  result.piece.assign(pieces, -1);
  for (int k = 0; k < n; ++k) {
    const auto found = owner.find(sets.root(k));
    const int part = found == owner.end() ? -1 : found->second;
    if (index[k] < pieces) {
      result.piece[index[k]] = part;
    } else {
      result.wet.push_back(cell.wet[index[k] - pieces]);
      result.wet_owner.push_back(part);
    }
  }
  return result;
}

/// Area that two polygons in one plane have in common.
double common_area(const Polygon& polygon, const Polygon& other, double size) {
  // Of thinner ones not even the direction of the normal is known.
  const double least = negligible * size * size;
  if (length(vector_area(polygon)) < least || length(vector_area(other)) < least) return 0;
  return length(vector_area(common_part(polygon, other, vector_area(other), negligible * size)));
}

/// In space: convex leaves of the wet part that share faces.
class LeafParts {
 public:
  LeafParts(const Outline& outline, const CutCell& cell, double size)
      : outline_(outline),
        cell_(cell),
        size_(size),
        leaves_(wet_leaves(outline, cell, true)),
        sets_(static_cast<int>(leaves_.size())) {
    const int n = static_cast<int>(leaves_.size());
    for (int a = 0; a < n; ++a)
      for (int b = a + 1; b < n; ++b)
        if (sets_.root(a) != sets_.root(b) && share_face(leaves_[a], leaves_[b])) sets_.unite(a, b);
  }

  Assignment assign() {
    Assignment result;
    for (int k = 0; k < static_cast<int>(leaves_.size()); ++k)
      if (number_.try_emplace(sets_.root(k), result.count).second) ++result.count;
    for (int k = 0; k < static_cast<int>(leaves_.size()); ++k) add_wet(k, result);
    std::map<int, int> film;  // by face
    for (const FacetPiece& p : cell_.pieces) {
      const int side = p.handed_over ? -1 : covered_side(p);
      if (side < 0) {
        result.piece.push_back(p.handed_over ? -1 : part_behind(p));
        continue;
      }
      const auto [found, is_new] = film.try_emplace(outline_.sides[side].face, result.count);
      if (is_new) ++result.count;
      result.piece.push_back(found->second);
      add_polygon({cell_.points.begin() + p.first, cell_.points.begin() + p.first + p.count},
                  outline_.sides[side], found->second, result);
    }
    return result;
  }

 private:
  [[nodiscard]] bool share_face(const Convex& a, const Convex& b) const {
    for (const Convex::Face& f : a.faces)
      for (const Convex::Face& g : b.faces)
        if (f.origin < 0 && f.origin == g.origin &&
            common_area(f.corner, g.corner, size_) > negligible * size_ * size_)
          return true;
    return false;
  }
  void add_wet(int leaf, Assignment& result) {
    for (const Convex::Face& face : leaves_[leaf].faces)
      if (face.origin >= 0)
        add_polygon(face.corner, outline_.sides[face.origin], number_.at(sets_.root(leaf)), result);
  }
  void add_polygon(const Polygon& x, const Side& side, int owner, Assignment& result) const {
    append_wet(side.face, side_normal(outline_, side), x, result.wet);
    result.wet_owner.resize(result.wet.size(), owner);
  }
  /// The side of the cell in whose plane a piece lies so that the wet part between them has no thickness, -1
  /// where there is none. That film is a part of its own: it belongs to what lies behind the side.
  [[nodiscard]] int covered_side(const FacetPiece& piece) const {
    for (int s = outline_.first_side[cell_.cell]; s < outline_.first_side[cell_.cell + 1]; ++s) {
      const Vector normal = side_normal(outline_, outline_.sides[s]);
      const Vector& origin = outline_.position[outline_.sides[s].vertex[0]];
      bool covered = dot(normal, piece.normal) < -0.999;
      for (int k = 0; k < piece.count && covered; ++k)
        covered = std::abs(dot(normal, cell_.points[piece.first + k] - origin)) < 1e-13 * size_;
      if (covered) return s;
    }
    return -1;
  }
  /// The part that a piece of the interface bounds: that with most of it as its face.
  [[nodiscard]] int part_behind(const FacetPiece& piece) {
    const Polygon polygon(cell_.points.begin() + piece.first,
                          cell_.points.begin() + piece.first + piece.count);
    std::map<int, double> shared;
    for (std::size_t k = 0; k < leaves_.size(); ++k)
      for (const Convex::Face& face : leaves_[k].faces) {
        const Vector out = vector_area(face.corner);
        if (face.origin >= 0 || dot(out, piece.normal) < 0.999 * length(out)) continue;
        if (std::abs(dot(piece.normal, face.corner[0] - polygon[0])) > negligible * size_) continue;
        shared[number_.at(sets_.root(static_cast<int>(k)))] += common_area(polygon, face.corner, size_);
      }
    const auto most = std::max_element(shared.begin(), shared.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == shared.end() || most->second == 0 ? -1 : most->first;
  }

  const Outline& outline_;
  const CutCell& cell_;
  double size_;
  std::vector<Convex> leaves_;
  DisjointSets sets_;
  std::map<int, int> number_;  ///< of the part, by the root of its leaves
};

/// In space the wet part is worth dividing only where interfaces face each other.
bool may_be_parted(const CutCell& cell) {
  for (const FacetPiece& a : cell.pieces)
    for (const FacetPiece& b : cell.pieces)
      if (dot(a.normal, b.normal) < -0.1) return true;
  return false;
}

void append(const CutCell& from, const FacetPiece& piece, CutCell& to) {
  FacetPiece copy = piece;
  copy.first = static_cast<int>(to.points.size());
  to.points.insert(to.points.end(), from.points.begin() + piece.first,
                   from.points.begin() + piece.first + piece.count);
  to.pieces.push_back(copy);
}

/// The part on whose wet face a piece was laid.
int nearest_part(const std::vector<CellPart>& parts, const Vector& x) {
  int nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const SideSimplex& w : parts[p].cut.wet) {
      if ((parts[p].cut.dry_faces >> w.face & 1U) == 0) continue;
      const Vector middle = 1.0 / 3 * (w.corner[0] + w.corner[1] + w.corner[2]);
      if (const double distance = length(middle - x); distance < least) {
        least = distance;
        nearest = static_cast<int>(p);
      }
    }
  return nearest;
}

int largest(const std::vector<CellPart>& parts) {
  return static_cast<int>(std::max_element(parts.begin(), parts.end(),
                                           [](const CellPart& a, const CellPart& b) {
                                             return a.cut.wet_volume < b.cut.wet_volume;
                                           }) -
                          parts.begin());
}

std::vector<CellPart> divide(const Outline& outline, const CutCell& cell, const Assignment& assignment) {
  std::vector<CellPart> parts(assignment.count);
  for (CellPart& part : parts) {
    part.cut.cell = cell.cell;
    part.cut.united = true;
    part.cut.dry_faces = cell.dry_faces;
  }
  for (std::size_t k = 0; k < cell.pieces.size(); ++k)
    if (assignment.piece[k] >= 0) append(cell, cell.pieces[k], parts[assignment.piece[k]].cut);
  for (std::size_t w = 0; w < assignment.wet.size(); ++w)
    if (assignment.wet_owner[w] >= 0) parts[assignment.wet_owner[w]].cut.wet.push_back(assignment.wet[w]);
  for (CellPart& part : parts) measure(outline, part.cut);
  const int rest = largest(parts);
  for (std::size_t k = 0; k < cell.pieces.size(); ++k) {
    if (assignment.piece[k] >= 0) continue;
    const FacetPiece& p = cell.pieces[k];
    append(cell, p, parts[p.handed_over ? nearest_part(parts, cell.points[p.first]) : rest].cut);
  }
  for (std::size_t w = 0; w < assignment.wet.size(); ++w)
    if (assignment.wet_owner[w] < 0) parts[rest].cut.wet.push_back(assignment.wet[w]);
  return parts;
}

}  // namespace

Vector wet_centre(int dimension, const CutCell& cell, const Vector& middle) {
  double volume = 0, weight = 0;
  Vector moment{}, border{};
  visit_boundary(dimension, cell, [&](const std::array<Vector, 3>& x, double sign) {
    const Vector area = vector_area(dimension, x[0], x[1], x[2]);
    const double part = sign / dimension * dot(x[0] - middle, area);
    Vector sum = middle;
    for (int k = 0; k < dimension; ++k) sum = sum + x[k];
    volume += part;
    moment = moment + part / (dimension + 1) * sum;
    weight += length(area);
    border = border + length(area) / dimension * (sum - middle);
  });
  return volume > negligible * cell.volume ? 1 / volume * moment : 1 / weight * border;
}

std::vector<CellPart> connected_parts(const Outline& outline, const CutCell& cell, bool is_convex) {
  const int dim = outline.dimension;
  const double size = std::pow(cell.volume, 1.0 / dim);
  Assignment assignment;
  if (dim == 2)
    assignment = chains(cell, size);
  else if (is_convex && may_be_parted(cell))
    assignment = LeafParts(outline, cell, size).assign();
  if (assignment.count < 2) return {};
  std::vector<CellPart> parts = divide(outline, cell, assignment);
  for (CellPart& part : parts) {
    measure(outline, part.cut);
    part.centre = wet_centre(dim, part.cut, outline.centre(cell.cell));
  }
  // By a direction that no symmetry of a mesh prefers.
  const Vector direction{1, 0.6180339887, 0.3819660113};
  std::sort(parts.begin(), parts.end(), [&](const CellPart& a, const CellPart& b) {
    return dot(a.centre, direction) < dot(b.centre, direction);
  });
  return parts;
}

bool touch(int dimension, const CutCell& first, int first_face, const CutCell& second, int second_face,
           double size) {
  double common = 0;
  for (const SideSimplex& a : first.wet) {
    if (a.face != first_face) continue;
    for (const SideSimplex& b : second.wet) {
      if (b.face != second_face) continue;
      if (dimension == 3) {
        common += common_area({a.corner.begin(), a.corner.end()}, {b.corner.begin(), b.corner.end()}, size);
        continue;
      }
      const Vector along = a.corner[1] - a.corner[0];
      const double whole = length(along);
      if (whole == 0) continue;
      const double from = dot(b.corner[0] - a.corner[0], along) / whole,
                   to = dot(b.corner[1] - a.corner[0], along) / whole;
      common += std::max(0.0, std::min(whole, std::max(from, to)) - std::max(0.0, std::min(from, to)));
    }
  }
  return common > negligible * std::pow(size, dimension - 1);
}

bool contains(int dimension, const CutCell& cell, const Vector& x) {
  if (dimension == 3) return is_wet_at(cell, x);
  std::vector<Stretch> boundary;
  visit_boundary(2, cell, [&](const std::array<Vector, 3>& corner, double) {
    boundary.push_back({corner[0], corner[1], true});
  });
  return encloses(boundary, x);
}

void merge_parts(const Outline& outline, std::vector<CellPart>& parts, int from, int to) {
  CutCell& target = parts[to].cut;
  for (const FacetPiece& piece : parts[from].cut.pieces) append(parts[from].cut, piece, target);
  target.wet.insert(target.wet.end(), parts[from].cut.wet.begin(), parts[from].cut.wet.end());
  measure(outline, target);
  parts[to].centre = wet_centre(outline.dimension, target, outline.centre(target.cell));
  parts.erase(parts.begin() + from);
}

}  // namespace seam::cutting
