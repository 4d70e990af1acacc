// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "seam/contact/opposite_points.hpp"

namespace seam {

template <class T>
class StateArray;

/// Watches over two surfaces that may touch: neither must end up behind the other one. Nothing in the
/// equations forbids it. A state in which bodies have passed through each other solves them all, since no
/// point has an opposite one any more, and a long step or a large increment gets there at once.
class Passage {
 public:
  /// @param other null where the opposite surface is given
  Passage(std::shared_ptr<const BodySurface> own, std::shared_ptr<const BodySurface> other,
          ContactWindow window);

  /// @param opposite the other surface at the start of the step
  void begin_step(Surface opposite);
  /// @param least_gap that has been found between the surfaces as they are now, m
  /// @throws StepRefused where a point of the surface that was in front of a facet of the other one, or
  /// behind it by no more than the window's depth, is behind it by more; the same on all ranks
  void check(const OppositePoints& opposite, double least_gap);

 private:
  [[nodiscard]] bool is_needed(double way, double least_gap);
  [[nodiscard]] bool has_passed(const cutting::Vector& start, const cutting::Vector& end,
                                const cutting::Vector& normal, bool overlaps, const Surface& now) const;
  std::shared_ptr<const BodySurface> own_, other_;
  ContactWindow window_;
  /// By how much surfaces overlap, m: what does so by much might lose sight of the other bit by bit.
  StateArray<double>& overlap_;
  double deepest_ = 0;  ///< overlap of the step so far, m
  bool has_begun_ = false;
  Surface own_start_, opposite_start_;
};

}  // namespace seam
