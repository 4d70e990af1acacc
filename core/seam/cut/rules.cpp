// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "seam/cut/cell_map.hpp"
#include "seam/cut/fitted_rule.hpp"
#include "seam/cut/geometry.hpp"
#include "seam/cut/interface_motion.hpp"
#include "seam/cut/moments.hpp"
#include "seam/cut/moving_piece.hpp"
#include "seam/mesh/lagrange.hpp"
#include "seam/mesh/quadrature.hpp"

namespace seam {
namespace {

using namespace cutting;

void append(int dimension, const Vector& x, std::vector<double>& values) {
  values.insert(values.end(), x.begin(), x.begin() + dimension);
}

void clear(InterfaceRule& rule) {
  for (auto* values :
       {&rule.reference, &rule.weight, &rule.position, &rule.normal, &rule.facet_reference, &rule.span})
    values->clear();
  rule.body.clear();
  rule.facet.clear();
}

/// Coordinates of a position in the frame of a facet: vertex 0 the origin, the others the unit points.
std::array<double, 2> on_facet(const Surface& surface, int facet, const Vector& x) {
  const int dim = surface.dimension;
  std::array<Vector, 3> v{};
  for (int k = 0; k < dim; ++k)
    for (int i = 0; i < dim; ++i)
      v[k][i] = surface.points[static_cast<std::size_t>(surface.facets[facet * dim + k]) * dim + i];
  const Vector a = v[1] - v[0], r = x - v[0];
  if (dim == 2) return {std::clamp(dot(r, a) / dot(a, a), 0.0, 1.0), 0.0};
  const Vector b = v[2] - v[0], normal = cross(a, b);
  const double square = dot(normal, normal);
  std::array<double, 2> s{std::max(0.0, dot(cross(r, b), normal) / square),
                          std::max(0.0, dot(cross(a, r), normal) / square)};
  const double sum = std::max(1.0, s[0] + s[1]);
  return {s[0] / sum, s[1] / sum};
}

double facet_length(const Surface& surface, int facet) {
  const double* a = &surface.points[static_cast<std::size_t>(surface.facets[facet * 2]) * 2];
  const double* b = &surface.points[static_cast<std::size_t>(surface.facets[facet * 2 + 1]) * 2];
  return std::hypot(b[0] - a[0], b[1] - a[1]);
}

/// In the plane a piece that is laid onto a narrow mouth stands for no more of its facet than it weighs: the
/// rest of that is not wet.
void shorten(double& from, double& to, double most) {
  const double excess = std::abs(to - from) - most;
  if (excess <= 0) return;
  const double each = std::copysign(excess / 2, to - from);
  from += each;
  to -= each;
}

/// Onto the closest point of the reference cell, as good as its coordinates allow.
Vector into_cell(CellType type, Vector reference) {
  double sum = 0;
  for (double& x : reference) {
    x = std::clamp(x, 0.0, 1.0);
    sum += x;
  }
  return is_simplex(type) && sum > 1 ? 1 / sum * reference : reference;
}

}  // namespace

void CutMesh::volume_rule(int cell, int degree, CutRule& rule, int part) const {
  static thread_local std::vector<double> moment;
  rule.reference.clear();
  rule.weight.clear();
  if (state_[cell] == CellState::body) return;
  const int dim = mesh_->dimension();
  const CellMap map(*mesh_, cell);
  const FittedRule& fitted = FittedRule::get(dim, degree);
  // Of a cell that is not affine polynomials in space are integrated: its own have no exact integrals.
  const CellMap frame = map.linearised();
  volume_moments(dim, frame, geometry_->at(cell, part), degree, moment);
  rule.reference = fitted.points();
  if (!map.affine())
    for (auto p = rule.reference.begin(); p != rule.reference.end(); p += dim) {
      Vector point{};
      std::copy_n(p, dim, point.begin());
      point = map.to_reference(frame.to_space(point));
      std::copy_n(point.begin(), dim, p);
    }
  rule.weight.resize(fitted.count());
  fitted.weights(moment.data(), rule.weight.data());
}

void CutMesh::face_rule(int cell, int face, int degree, CutRule& rule, int part) const {
  static thread_local std::vector<double> moment;
  rule.reference.clear();
  rule.weight.clear();
  if (state_[cell] == CellState::body) return;
  const CutCell& cut = geometry_->at(cell, part);
  const auto on_face = [&](const SideSimplex& w) { return w.face == face; };
  if ((cut.dry_faces >> face & 1U) != 0 || std::none_of(cut.wet.begin(), cut.wet.end(), on_face)) return;
  const CellTopology& shape = topology(mesh_->type());
  const int dim = mesh_->dimension();
  const auto corner = [&](int k) {
    Vector x{};
    for (int i = 0; i < dim; ++i) x[i] = shape.node_coordinates[shape.faces[face][k] * dim + i];
    return x;
  };
  const int last = static_cast<int>(shape.faces[face].size()) - 1;
  const FittedRule& fitted = FittedRule::get(dim - 1, degree);
  face_moments(dim, CellMap(*mesh_, cell), cut, face, corner(0),
               {corner(1) - corner(0), corner(last) - corner(0)}, degree, moment);
  rule.weight.resize(fitted.count());
  fitted.weights(moment.data(), rule.weight.data());
  rule.reference.resize(static_cast<std::size_t>(fitted.count()) * dim);
  for (int q = 0; q < fitted.count(); ++q)
    face_to_cell(shape, face, &fitted.points()[q * (dim - 1)], &rule.reference[q * dim]);
}

void CutMesh::interface_rule(int cell, int degree, InterfaceRule& rule, InterfaceMotion* motion, int part,
                             const PieceBreaks& breaks) const {
  const CutCell& cut = geometry_->at(cell, part);
  const int dim = mesh_->dimension();
  const CellMap map(*mesh_, cell);
  const Quadrature& base = quadrature(dim == 2 ? CellType::segment : CellType::triangle, degree);
  clear(rule);
  if (motion) *motion = {};
  const auto place = [&](const FacetPiece& piece, const Vector& position) {
    return on_facet(geometry_->bodies[piece.body], piece.facet, position);
  };
  const auto add = [&](const FacetPiece& piece, const Vector& position, double weight) {
    Vector reference = map.to_reference(position), x = position;
    if (piece.handed_over) {
      reference = into_cell(mesh_->type(), reference);
      x = map.to_space(reference);
    }
    const auto s = place(piece, position);
    append(dim, reference, rule.reference);
    append(dim, x, rule.position);
    append(dim, piece.normal, rule.normal);
    rule.weight.push_back(weight);
    rule.body.push_back(piece.body);
    rule.facet.push_back(piece.facet);
    rule.facet_reference.insert(rule.facet_reference.end(), s.begin(), s.begin() + dim - 1);
  };
  for (const FacetPiece& piece : cut.pieces) {
    const Vector* x = &cut.points[piece.first];
    const Surface& body = geometry_->bodies[piece.body];
    if (dim == 2) {
      std::optional<MovingPiece<2>> moving;
      if (motion) moving.emplace(geometry_->outline, cut, piece, body);
      const double area = -piece.scale * dot(vector_area(dim, x[0], x[1], x[1]), piece.normal);
      if (area == 0) continue;
      auto [from, to] = std::pair(place(piece, x[0])[0], place(piece, x[1])[0]);
      if (piece.handed_over) shorten(from, to, area / facet_length(body, piece.facet));
      std::vector<double> ends{0};  // shares of the piece
      if (breaks && !piece.handed_over)
        for (const double at : breaks(piece.body, piece.facet, from, to))
          ends.push_back((at - from) / (to - from));
      ends.push_back(1);
      for (std::size_t k = 0; k + 1 < ends.size(); ++k)
        for (int q = 0; q < base.count(); ++q) {
          const double s = ends[k] + base.points[q] * (ends[k + 1] - ends[k]);
          add(piece, x[0] + s * (x[1] - x[0]), area * base.weights[q] * (ends[k + 1] - ends[k]));
          for (const double end : {ends[k], ends[k + 1]}) rule.span.push_back(from + end * (to - from));
          if (!moving) continue;
          MovingPoint<2, 1>& point = motion->in_plane.emplace_back(moving->point({0, 1}, {1 - s, s}));
          for (const std::size_t end : {0, 1})
            point.span[end] = piece.handed_over
                                  ? MovingPiece<2>::Number(rule.span[rule.span.size() - 2 + end])
                                  : moving->on_facet(ends[k + end]);
        }
      continue;
    }
    std::optional<MovingPiece<3>> moving;
    if (motion) moving.emplace(geometry_->outline, cut, piece, body);
    for (int k = 1; k + 1 < piece.count; ++k) {
      const Vector &a = x[k], &b = x[k + 1];
      const double area = -piece.scale * dot(vector_area(dim, x[0], a, b), piece.normal);
      if (area == 0) continue;
      for (int q = 0; q < base.count(); ++q) {
        const double* s = &base.points[q * base.dimension];
        if (moving) motion->in_space.push_back(moving->point({0, k, k + 1}, {1 - s[0] - s[1], s[0], s[1]}));
        add(piece, x[0] + s[0] * (a - x[0]) + s[1] * (b - x[0]), area * base.weights[q] * 2);
      }
    }
  }
}

}  // namespace seam
