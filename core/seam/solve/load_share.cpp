// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/load_share.hpp"

#include "seam/assembly/assembler.hpp"
#include "seam/field/field.hpp"

namespace seam {

LoadShare::LoadShare(Problem& problem, const TimePoint& at) : problem_(problem) {
  problem.update_spaces(at);
  problem.assembler().assemble(at, false);
  problem.assembler().keep_residual();
  for (const FieldEntry& entry : problem.fields())
    for (Block& block : entry.field->blocks())
      for (std::size_t i = 0; i < block.prescribed.size(); ++i)
        if (block.prescribed[i]) given_.push_back({&block, i, block.now.value[i], block.prescribed_value[i]});
}

LoadShare::~LoadShare() { set(1); }

void LoadShare::set(double share) {
  problem_.assembler().leave_out(1 - share);
  // What comes to be prescribed on the way, as the level of a pocket, is so as a whole.
  for (const auto& [block, unknown, start, end] : given_)
    if (unknown < block->prescribed_value.size())
      block->prescribed_value[unknown] = share < 1 ? start + share * (end - start) : end;
}

}  // namespace seam
