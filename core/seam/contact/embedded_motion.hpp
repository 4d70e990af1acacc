// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/contact/embedded_surface.hpp"

/// How points of an embedded surface are noted, wet or dry.
namespace seam {

/// Of the last point added.
template <int dim, int facets>
void EmbeddedSurface::add_motion(Element& element, int facet, const MovingPoint<dim, facets>& point,
                                 std::size_t moves) const {
  PointMotion& motion = element.motion;
  const int* places = own_->places(facet);
  motion.node.insert(motion.node.end(), places, places + dim);
  append_moves(point.position, moves, motion.position);
  append_moves(point.normal, moves, motion.normal);
  append_moves(point.relative_weight, moves, motion.relative_weight);
  append_moves(own_->moved_in_cell<dim>(facet, point.on_facet), moves, motion.reference[1]);
}

template <int dim>
void EmbeddedSurface::add_partner(Element& element, const OppositePoints::Hit& hit,
                                  const MovingPair<dim>& pair, std::size_t moves) const {
  other_->to_cell(hit.facet, hit.pair.on_opposite.data(), element.other.reference);
  element.gap.push_back(hit.pair.gap);
  PointMotion& motion = element.motion;
  const int* places = other_->places(hit.facet);
  motion.node.insert(motion.node.end(), places, places + dim);
  append_moves(other_->moved_in_cell<dim>(hit.facet, pair.on_opposite), moves, motion.reference[2]);
  append_moves(pair.gap, moves, motion.gap);
}

}  // namespace seam
