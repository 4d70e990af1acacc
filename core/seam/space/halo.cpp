// SPDX-License-Identifier: BSD-3-Clause
#include "seam/space/halo.hpp"

namespace seam {

Halo::Halo(const Communicator& communicator, int owned, const std::vector<int>& ghost_global,
           const std::vector<int>& ghost_owner, const std::function<int(int)>& local_of_global)
    : communicator_(communicator), send_(communicator.size()), receive_(communicator.size()) {
  std::vector<std::vector<int>> wanted(communicator.size());
  for (std::size_t g = 0; g < ghost_global.size(); ++g) {
    wanted[ghost_owner[g]].push_back(ghost_global[g]);
    receive_[ghost_owner[g]].push_back(owned + static_cast<int>(g));
  }
  send_ = communicator.exchange(wanted);
  for (auto& list : send_)
    for (int& node : list) node = local_of_global(node);
}

}  // namespace seam
