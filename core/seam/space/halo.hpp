// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "seam/base/communicator.hpp"

namespace seam {

/// Copies values of nodes from the rank that owns them to the ranks that see them as ghosts.
class Halo {
 public:
  Halo() = default;
  /// Collective.
  /// @param owned number of owned nodes; ghosts follow in the local numbering
  /// @param ghost_global global number of each ghost
  /// @param ghost_owner rank owning each ghost
  /// @param local_of_global finds an owned node
  Halo(const Communicator& communicator, int owned, const std::vector<int>& ghost_global,
       const std::vector<int>& ghost_owner, const std::function<int(int)>& local_of_global);

  /// Collective. Overwrites the ghosts of `values`, which holds `block` entries per local node.
  template <class T>
  void update(std::vector<T>& values, int block) const {
    std::vector<std::vector<T>> out(send_.size());
    for (std::size_t r = 0; r < send_.size(); ++r)
      for (const int node : send_[r])
        out[r].insert(out[r].end(), values.begin() + static_cast<std::ptrdiff_t>(node) * block,
                      values.begin() + static_cast<std::ptrdiff_t>(node + 1) * block);
    if (send_.size() <= 1) return;
    const auto in = communicator_.exchange(out);
    for (std::size_t r = 0; r < in.size(); ++r)
      for (std::size_t i = 0; i < receive_[r].size(); ++i)
        std::copy_n(in[r].begin() + static_cast<std::ptrdiff_t>(i) * block, block,
                    values.begin() + static_cast<std::ptrdiff_t>(receive_[r][i]) * block);
  }

 private:
  Communicator communicator_;
  std::vector<std::vector<int>> send_;     ///< owned nodes, per rank
  std::vector<std::vector<int>> receive_;  ///< ghosts, per rank
};

}  // namespace seam
