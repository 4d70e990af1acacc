// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/input/face_match.hpp"

#include <algorithm>
#include <tuple>

namespace seam {

namespace {

/// Order-free key of a face.
std::array<int, 4> sorted(std::span<const int> vertices) {
  std::array<int, 4> key = {-1, -1, -1, -1};
  std::copy_n(vertices.begin(), std::min<std::size_t>(vertices.size(), key.size()), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

}  // namespace

FaceMatch::FaceMatch(const MeshData& mesh) {
  const CellTopology& t = topology(mesh.type);
  const int n = mesh.nodes_per_cell();
  entries_.reserve(static_cast<std::size_t>(mesh.cell_count()) * t.faces.size());
  std::vector<int> vertices;
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int f = 0; f < static_cast<int>(t.faces.size()); ++f) {
      vertices.clear();
      for (const int v : t.faces[f]) vertices.push_back(mesh.cells[static_cast<std::size_t>(c) * n + v]);
      entries_.push_back({sorted(vertices), {c, f}});
    }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.vertices, a.face.cell, a.face.face) < std::tie(b.vertices, b.face.cell, b.face.face);
  });
}

CellFace FaceMatch::find(std::span<const int> vertices) const {
  const std::array<int, 4> key = sorted(vertices);
  const auto found =
      std::lower_bound(entries_.begin(), entries_.end(), key,
                       [](const Entry& e, const std::array<int, 4>& k) { return e.vertices < k; });
  return found != entries_.end() && found->vertices == key ? found->face : CellFace{-1, -1};
}

std::vector<CellFace> FaceMatch::outer() const {
  std::vector<CellFace> faces;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const bool as_before = i > 0 && entries_[i - 1].vertices == entries_[i].vertices;
    const bool as_next = i + 1 < entries_.size() && entries_[i + 1].vertices == entries_[i].vertices;
    if (!as_before && !as_next) faces.push_back(entries_[i].face);
  }
  std::sort(faces.begin(), faces.end(), [](const CellFace& a, const CellFace& b) {
    return std::tie(a.cell, a.face) < std::tie(b.cell, b.face);
  });
  return faces;
}

std::vector<CellFace> outer_faces(const MeshData& mesh) { return FaceMatch(mesh).outer(); }

}  // namespace seam
