// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/load_share.hpp"

#include "seam/assembly/assembler.hpp"
#include "seam/field/field.hpp"

namespace seam {

LoadShare::LoadShare(Problem& problem, const TimePoint& at) : problem_(problem) {
  problem.update_spaces(at);
  problem.assembler().assemble(at, true);
  problem.assembler().keep_residual();
  for (const FieldEntry& entry : problem.fields())
    for (Block& block : entry.field->blocks())
      given_.push_back({&block, block.now.value, block.prescribed_value});
}

LoadShare::~LoadShare() { set(1); }

void LoadShare::set(double share) {
  problem_.assembler().leave_out(1 - share);
  for (const Given& given : given_) {
    std::vector<double>& value = given.block->prescribed_value;
    // What has come alive since then is given as a whole.
    for (std::size_t i = 0; i < given.end.size(); ++i)
      value[i] = share < 1 ? given.start[i] + share * (given.end[i] - given.start[i]) : given.end[i];
  }
}

}  // namespace seam
