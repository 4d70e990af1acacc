// SPDX-License-Identifier: BSD-3-Clause
#include "seam/assembly/binding.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "seam/base/plugin_fault.hpp"
#include "seam/term/term_name.hpp"

namespace seam {
namespace {

/// The highest rate that a slot needs its unknown to have.
int rate_order(Level level) {
  if (level == Level::rate || level == Level::old_rate) return 1;
  return level == Level::second_rate ? 2 : 0;
}

void check_operand(const BoundTerm& bound, const IntegrationDomain& domain, std::size_t k, int components) {
  const Operand& operand = bound.operands[k];
  const Field& field = *domain.fields().at(operand.side);
  const Field::Place place = call_plugin(
      bound.where, [&] { return describe(bound, domain); }, [&] { return field.place(operand.unknown); });
  if (components > 0 && place.components != components)
    throw PluginFault(
        bound.where,
        fmt::format("{}: its operand {} has {} components, the unknown '{}' that it stands for has {}",
                    describe(bound, domain), k, components, operand.unknown, place.components));
}

}  // namespace

std::string describe(const BoundTerm& bound, const IntegrationDomain& domain) {
  std::vector<std::string> unknowns;
  for (const Operand& operand : bound.operands)
    unknowns.push_back(fmt::format("{}.{}", domain.fields().at(operand.side)->name(), operand.unknown));
  return fmt::format("the term '{}'{}{} on {}{}", term_name(*bound.term), unknowns.empty() ? "" : " of ",
                     fmt::join(unknowns, ", "), domain.description(), plugin_of(*bound.term));
}

void check_binding(const BoundTerm& bound, const IntegrationDomain& domain) {
  const std::vector<Field*> fields = domain.fields();
  const Signature& signature = bound.term->signature(fields.front()->mesh().dimension());
  for (const Operand& operand : bound.operands)
    if (operand.side < 0 || operand.side >= static_cast<int>(fields.size()))
      throw PluginFault(bound.where,
                        fmt::format("a term on {}{} speaks of side {}; there are {}", domain.description(),
                                    plugin_of(*bound.term), operand.side, fields.size()));
  if (bound.operands.size() != signature.components.size())
    throw PluginFault(bound.where, fmt::format("{}: its kernel speaks of {} unknowns, but {} were given",
                                               describe(bound, domain), signature.components.size(),
                                               bound.operands.size()));
  for (std::size_t k = 0; k < bound.operands.size(); ++k)
    check_operand(bound, domain, k, signature.components[k]);
  for (const Slot& slot : signature.inputs) {
    const Operand& operand = bound.operands[slot.operand];
    const Field& field = *fields[operand.side];
    const Field::Place place = field.place(operand.unknown);
    const int order = field.blocks()[place.block].time_order[place.offset];
    if (order < rate_order(slot.level))
      throw PluginFault(
          bound.where,
          fmt::format("{}: it reads a {}rate of '{}', which has none: its time_order is {}; declare at "
                      "least {} in the field's unknowns()",
                      describe(bound, domain), rate_order(slot.level) == 2 ? "second " : "", operand.unknown,
                      order, rate_order(slot.level)));
  }
}

}  // namespace seam
