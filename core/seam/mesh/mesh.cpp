// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/mesh.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "seam/base/diagnostics.hpp"
#include "seam/mesh/lagrange.hpp"
#include "seam/mesh/partition.hpp"
#include "seam/mesh/quadrature.hpp"

namespace seam {

Mesh::Mesh(std::string name, std::shared_ptr<const MeshData> whole, const Communicator& communicator,
           const std::vector<double>& weights)
    : name_(std::move(name)), whole_(std::move(whole)), communicator_(communicator) {
  nodes_per_cell_ = whole_->nodes_per_cell();
  assign_owners(weights);
  choose_cells();
  copy_geometry();
  copy_boundaries();
}

void Mesh::assign_owners(const std::vector<double>& weights) {
  const int dim = dimension(), total = whole_->cell_count();
  std::vector<double> centres(static_cast<std::size_t>(total) * dim, 0.0);
  for (int c = 0; c < total; ++c)
    for (int a = 0; a < nodes_per_cell_; ++a) {
      const int node = whole_->cells[static_cast<std::size_t>(c) * nodes_per_cell_ + a];
      for (int d = 0; d < dim; ++d)
        centres[static_cast<std::size_t>(c) * dim + d] +=
            whole_->coordinates[static_cast<std::size_t>(node) * dim + d] / nodes_per_cell_;
    }
  // Fewer cells than ranks leave some ranks without any, which is allowed.
  owner_of_global_cell_ =
      partition_points(dim, centres, weights, std::min(communicator_.size(), std::max(1, total)));
}

void Mesh::choose_cells() {
  const int total = whole_->cell_count();
  std::vector<char> near(whole_->node_count(), 0);
  for (int c = 0; c < total; ++c) {
    if (owner_of_global_cell_[c] != communicator_.rank()) continue;
    global_cell_.push_back(c);
    for (int a = 0; a < nodes_per_cell_; ++a)
      near[whole_->cells[static_cast<std::size_t>(c) * nodes_per_cell_ + a]] = 1;
  }
  owned_cells_ = static_cast<int>(global_cell_.size());
  for (int c = 0; c < total; ++c) {
    if (owner_of_global_cell_[c] == communicator_.rank()) continue;
    const int* nodes = &whole_->cells[static_cast<std::size_t>(c) * nodes_per_cell_];
    if (std::any_of(nodes, nodes + nodes_per_cell_, [&](int node) { return near[node] != 0; }))
      global_cell_.push_back(c);
  }
}

void Mesh::copy_geometry() {
  const int dim = dimension(), vertices = topology(type()).vertices;
  geometry_.reserve(global_cell_.size() * nodes_per_cell_ * dim);
  for (const int c : global_cell_) {
    for (int a = 0; a < nodes_per_cell_; ++a) {
      const int node = whole_->cells[static_cast<std::size_t>(c) * nodes_per_cell_ + a];
      for (int d = 0; d < dim; ++d)
        geometry_.push_back(whole_->coordinates[static_cast<std::size_t>(node) * dim + d]);
    }
    const double* x = geometry_.data() + geometry_.size() - static_cast<std::size_t>(nodes_per_cell_) * dim;
    double largest = 0;
    for (int a = 0; a < vertices; ++a)
      for (int b = a + 1; b < vertices; ++b) {
        double square = 0;
        for (int d = 0; d < dim; ++d) square += std::pow(x[a * dim + d] - x[b * dim + d], 2);
        largest = std::max(largest, square);
      }
    diameter_.push_back(std::sqrt(largest));
    volume_.push_back(cell_volume(type(), order(), x));
  }
}

void Mesh::copy_boundaries() {
  std::vector<int> local(whole_->cell_count(), -1);
  for (int c = 0; c < cells(); ++c) local[global_cell_[c]] = c;
  for (const auto& [boundary_name, faces] : whole_->boundaries) {
    auto& mine = boundaries_[boundary_name];
    for (const CellFace& f : faces)
      if (local[f.cell] >= 0) mine.push_back({local[f.cell], f.face});
  }
}

const std::vector<CellFace>& Mesh::boundary(const std::string& boundary_name) const {
  const auto found = boundaries_.find(boundary_name);
  if (found != boundaries_.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& entry : boundaries_) known.push_back(entry.first);
  throw Error(fmt::format("mesh '{}' has no boundary '{}'; it has: {}", name_, boundary_name,
                          fmt::join(known, ", ")));
}

const std::vector<Mesh::InteriorFace>& Mesh::interior_faces() const {
  if (!faces_found_) find_faces();
  return interior_faces_;
}

const std::vector<CellFace>& Mesh::outer_faces() const {
  if (!faces_found_) find_faces();
  return outer_faces_;
}

void Mesh::find_faces() const {
  const CellTopology& cell = topology(type());
  struct Key {
    std::array<int, 4> vertices;
    CellFace face;
  };
  std::vector<Key> keys;
  for (int c = 0; c < cells(); ++c)
    for (int f = 0; f < static_cast<int>(cell.faces.size()); ++f) {
      Key key{{-1, -1, -1, -1}, {c, f}};
      for (std::size_t a = 0; a < cell.faces[f].size(); ++a)
        key.vertices[a] =
            whole_->cells[static_cast<std::size_t>(global_cell_[c]) * nodes_per_cell_ + cell.faces[f][a]];
      std::sort(key.vertices.begin(), key.vertices.end());
      keys.push_back(key);
    }
  std::sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
    return std::pair(a.vertices, global_cell_[a.face.cell]) <
           std::pair(b.vertices, global_cell_[b.face.cell]);
  });
  // Two keys in a row are the two sides of a face.
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const bool owned = keys[k].face.cell < owned_cells_;
    if (k + 1 < keys.size() && keys[k].vertices == keys[k + 1].vertices) {
      if (owned) interior_faces_.push_back({{keys[k].face, keys[k + 1].face}});
      ++k;
    } else {
      outer_faces_.push_back(keys[k].face);
    }
  }
  std::ranges::sort(outer_faces_, {}, [](const CellFace& f) { return std::pair(f.cell, f.face); });
  std::sort(interior_faces_.begin(), interior_faces_.end(),
            [&](const InteriorFace& a, const InteriorFace& b) {
              return std::pair(a.side[0].cell, a.side[0].face) < std::pair(b.side[0].cell, b.side[0].face);
            });
  faces_found_ = true;
}

}  // namespace seam
