// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "seam/mesh/mesh.hpp"

namespace seam::cutting {

/// Values of owned cells for the ranks that hold them as ghosts. The lists are exchanged once.
class GhostValues {
 public:
  /// Collective.
  explicit GhostValues(const Mesh& mesh) : mesh_(&mesh), ghosts_(mesh.communicator().size()) {
    std::vector<std::vector<int>> wanted(mesh.communicator().size());
    std::map<int, int> local;
    for (int c = 0; c < mesh.owned_cells(); ++c) local[mesh.global_cell(c)] = c;
    for (int c = mesh.owned_cells(); c < mesh.cells(); ++c) {
      ghosts_[mesh.owner(c)].push_back(c);
      wanted[mesh.owner(c)].push_back(mesh.global_cell(c));
    }
    asked_ = mesh.communicator().exchange(wanted);
    for (auto& cells : asked_)
      for (int& c : cells) c = local.at(c);
  }

  /// Calls receive(ghost, value of its owner). Collective.
  template <class Value, class Receive>
  void update(const Value& value, const Receive& receive) const {
    std::vector<std::vector<int>> out(asked_.size());
    for (std::size_t r = 0; r < asked_.size(); ++r)
      for (const int c : asked_[r]) out[r].push_back(value(c));
    const auto in = mesh_->communicator().exchange(out);
    for (std::size_t r = 0; r < in.size(); ++r)
      for (std::size_t k = 0; k < in[r].size(); ++k) receive(ghosts_[r][k], in[r][k]);
  }

 private:
  const Mesh* mesh_;
  std::vector<std::vector<int>> ghosts_, asked_;  ///< [rank]
};

}  // namespace seam::cutting
