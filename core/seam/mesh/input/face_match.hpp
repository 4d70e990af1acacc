// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "seam/mesh/mesh_data.hpp"

namespace seam {

/// The faces of a mesh by their vertices. Node numbers of the mesh must be in range.
class FaceMatch {
 public:
  explicit FaceMatch(const MeshData& mesh);

  /// The face with these vertices, in any order; that of the lowest cell if two cells share it. A face number
  /// of -1 means that there is none.
  [[nodiscard]] CellFace find(std::span<const int> vertices) const;
  /// Faces of one cell only, by cell and face.
  [[nodiscard]] std::vector<CellFace> outer() const;

 private:
  struct Entry {
    std::array<int, 4> vertices;  ///< increasing, filled with -1 in front
    CellFace face;
  };
  std::vector<Entry> entries_;  ///< sorted
};

/// Faces that belong to one cell only, by cell and face.
std::vector<CellFace> outer_faces(const MeshData& mesh);

}  // namespace seam
