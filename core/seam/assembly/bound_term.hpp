// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "seam/base/diagnostics.hpp"
#include "seam/term/term.hpp"

namespace seam {

struct Element;

/// A term and where its operands are found.
struct BoundTerm {
  std::shared_ptr<const Term> term;
  std::vector<Operand> operands;
  std::array<int, 2> constants{-1, -1};  ///< indices into Element::constants, -1 when the term reads none
  /// Where sides' physics tell regions apart (Field::region): those in which the term holds, one a side.
  struct Region {
    int side, region;
  };
  std::vector<Region> regions = {};
  Location where = {};  ///< in the scene: the field or coupling that the term belongs to
  /// Whether the term holds on an element.
  [[nodiscard]] bool holds(const Element& element) const;
};

/// What elements are to the terms on them.
enum class ElementRole {
  integrate,          ///< the terms are integrated over the elements
  integrate_at_rest,  ///< the same, but how the points move is left out of the tangent
  sweep  ///< the elements bound a volume over which the terms are integrated: only the tangent's part that
         ///< stems from the elements' sweeping over that volume is computed
};

}  // namespace seam
