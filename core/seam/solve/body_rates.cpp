// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/body_rates.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "seam/field/field.hpp"
#include "seam/solve/problem.hpp"

namespace seam {
namespace {

/// Whether a quantity can be: unknowns have the rates that it reads.
bool has_rates_for(const FieldQuantity& quantity, const Field& field) {
  return std::ranges::all_of(quantity.terms, [&](const BoundTerm& bound) {
    return std::ranges::all_of(bound.term->signature(field.mesh().dimension()).inputs, [&](const Slot& slot) {
      if (slot.level == Level::now || slot.level == Level::old) return true;
      const Field::ComponentRange place = field.place(bound.operands.at(slot.operand).unknown);
      return field.blocks()[place.block].time_order[place.offset] >=
             (slot.level == Level::second_rate ? 2 : 1);
    });
  });
}

class RatesOfBodies {
 public:
  RatesOfBodies(std::vector<FieldEntry>& fields, const std::vector<Ties::Resolved>& ties,
                const Communicator& communicator)
      : communicator_(communicator) {
    for (FieldEntry& entry : fields) {
      if (entry.physics->support() == Support::point)
        bodies_.push_back({&entry, static_cast<int>(blocks_.size())});
      for (Block& block : entry.field->blocks()) blocks_.push_back(&block);
    }
    for (const Ties::Resolved& tie : ties) tie_of_[tie.unknown.key()] = &tie;
  }

  void carry() {
    for (const bool tied : {false, true})  // these to those that are given, too
      for (const auto& [entry, first] : bodies_)
        for (const Unknown& unknown : entry->field->unknowns())
          if (unknown.role != UnknownRole::derived) carry(entry->field->place(unknown.name), first, tied);
    for (const auto& body : bodies_) {
      const Field& field = *body.first->field;
      std::erase_if(body.first->outputs,
                    [&](const FieldQuantity& output) { return !has_rates_for(output, field); });
    }
  }

 private:
  void carry(const Field::ComponentRange& place, int first, bool tied) {
    Block& block = *blocks_[first + place.block];
    bool moves = true;
    for (int node = 0; node < block.space->owned_nodes(); ++node)
      for (int c = place.offset; c < place.offset + place.components; ++c)
        moves = moves && (block.prescribed[static_cast<std::size_t>(node) * block.size + c] != 0 ||
                          (tied && follows({first + place.block, block.space->global_node(node), c})));
    if (communicator_.any(!moves)) return;
    for (int c = place.offset; c < place.offset + place.components; ++c)
      block.time_order[c] = std::max(block.time_order[c], 1);
  }
  [[nodiscard]] bool follows(const UnknownPlace::Key& unknown) const {
    const auto tie = tie_of_.find(unknown);
    return tie != tie_of_.end() && std::ranges::all_of(tie->second->to, [&](const TiedTo& to) {
             return to.unknown.is_clock() || blocks_[to.unknown.block]->time_order[to.unknown.component] > 0;
           });
  }

  const Communicator& communicator_;
  std::vector<Block*> blocks_;                       ///< of all fields
  std::vector<std::pair<FieldEntry*, int>> bodies_;  ///< with the number of the first block
  std::map<UnknownPlace::Key, const Ties::Resolved*> tie_of_;
};

}  // namespace

void carry_rates_of_bodies(std::vector<FieldEntry>& fields, const std::vector<Ties::Resolved>& ties,
                           const Communicator& communicator) {
  RatesOfBodies(fields, ties, communicator).carry();
}

}  // namespace seam
