// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "seam/mesh/mesh_data.hpp"

namespace seam {

class Field;

/// A number on the nodes of one field's boundary that goes on on another field's.
struct JoinedFields {
  struct Side {
    const Field* field;
    int block, component;
    std::vector<CellFace> faces;  ///< of this rank's own cells: where it goes on
  };
  Side tied, other;
  /// Local nodes: one of this rank's own that is tied, and one of those that it is tied to.
  std::vector<std::pair<int, int>> nodes;
};

/// What a constraint may be, too: one that joins numbers of different fields, so that their levels are one.
class JoinsFields {
 public:
  virtual ~JoinsFields() = default;
  /// @pre it has been built
  [[nodiscard]] virtual const std::vector<JoinedFields>& joined() const = 0;
};

}  // namespace seam
