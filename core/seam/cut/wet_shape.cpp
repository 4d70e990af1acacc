// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "seam/cut/geometry.hpp"

namespace seam {
namespace {

using namespace cutting;

using Segment = std::array<Vector, 2>;
using Loop = std::vector<Vector>;

double distance(const Vector& a, const Vector& b) { return dot(a - b, a - b); }

/// Joins directed segments to closed loops: behind the end of one comes the one that starts closest to it, as
/// ends agree but for rounding.
std::vector<Loop> link(std::vector<Segment> segments) {
  std::erase_if(segments, [](const Segment& s) { return s[0] == s[1]; });
  std::vector<Loop> loops;
  while (!segments.empty()) {
    Loop loop{segments.back()[0]};
    Vector end = segments.back()[1];
    segments.pop_back();
    while (!segments.empty()) {
      const auto next = std::min_element(
          segments.begin(), segments.end(),
          [&](const Segment& a, const Segment& b) { return distance(a[0], end) < distance(b[0], end); });
      if (distance(loop.front(), end) <= distance((*next)[0], end)) break;
      loop.push_back(end);
      end = (*next)[1];
      segments.erase(next);
    }
    if (loop.size() > 2) loops.push_back(std::move(loop));
  }
  return loops;
}

void append(int dimension, const Loop& loop, WetShape& shape) {
  for (const Vector& x : loop) shape.points.insert(shape.points.end(), x.begin(), x.begin() + dimension);
  shape.first.push_back(static_cast<int>(shape.points.size()) / dimension);
}

/// Wet parts of a side's edge k, in the direction of the side.
void add_edge(const Outline& outline, const std::vector<int>& coverage, const CutCell& cell, const Side& side,
              int k, std::vector<Segment>& segments) {
  const bool forward = side.forward[k] > 0;
  std::vector<const Crossing*> crossings;
  for (const Crossing& x : cell.crossings)
    if (x.place == side.edge[k]) crossings.push_back(&x);
  std::sort(crossings.begin(), crossings.end(), [&](const Crossing* a, const Crossing* b) {
    return forward ? a->share < b->share : a->share > b->share;
  });
  int covered = coverage[side.vertex[k]];
  Vector from = outline.position[side.vertex[k]];
  for (const Crossing* x : crossings) {
    if (covered == 0) segments.push_back({from, x->position});
    covered += forward ? x->step : -x->step;
    from = x->position;
  }
  if (covered == 0) segments.push_back({from, outline.position[side.vertex[(k + 1) % 3]]});
}

void add_sides(const Outline& outline, const std::vector<int>& coverage, const CutCell& cell,
               WetShape& shape) {
  std::vector<Segment> segments;
  for (int s = outline.first_side[cell.cell]; s < outline.first_side[cell.cell + 1]; ++s) {
    segments.clear();
    for (int k = 0; k < 3; ++k) add_edge(outline, coverage, cell, outline.sides[s], k, segments);
    for (const Trace& t : cell.traces)
      if (t.side == s) segments.push_back({t.from, t.to});
    for (const Loop& loop : link(segments)) append(3, loop, shape);
  }
}

}  // namespace

void CutMesh::wet_shape(int cell, WetShape& shape, int part) const {
  const CutCell& cut = geometry_->at(cell, part);
  const int dim = mesh_->dimension();
  shape.points.clear();
  shape.first.assign(1, 0);
  std::vector<Segment> outline;
  for (const FacetPiece& p : cut.pieces) {
    if (p.handed_over) continue;
    Loop loop(cut.points.begin() + p.first, cut.points.begin() + p.first + p.count);
    std::reverse(loop.begin(), loop.end());
    if (dim == 2)
      outline.push_back({loop[0], loop[1]});
    else
      append(dim, loop, shape);
  }
  if (dim == 3 && !cut.united) {
    add_sides(geometry_->outline, geometry_->coverage, cut, shape);
    return;
  }
  for (const SideSimplex& w : cut.wet)
    if (dim == 2)
      outline.push_back(w.sign > 0 ? Segment{w.corner[0], w.corner[1]} : Segment{w.corner[1], w.corner[0]});
    else
      append(dim, {w.corner.begin(), w.corner.end()}, shape);
  for (const Loop& loop : link(outline)) append(dim, loop, shape);
}

}  // namespace seam
