// SPDX-License-Identifier: BSD-3-Clause
#include "seam/assembly/binding.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "seam/assembly/limits.hpp"
#include "seam/base/plugin_fault.hpp"
#include "seam/field/field.hpp"
#include "seam/term/term_name.hpp"

namespace seam {
namespace {

/// The highest rate that a slot needs its unknown to have.
int rate_order(Level level) {
  if (level == Level::rate || level == Level::old_rate) return 1;
  return level == Level::second_rate ? 2 : 0;
}

/// Whether what a term gives at a point changes with some of its inputs. A kernel may name what a parameter
/// of its then switches off, as the inertia of a fluid without mass.
bool depends_on(const Term& term, int dim, std::size_t first, std::size_t count) {
  const Signature& signature = term.signature(dim);
  const std::vector<double> place{0.21, 0.13, 0.34}, normal{0.36, 0.48, 0.8}, one{1.0};
  const double factors[most_operands][3] = {};
  // Away from zero, and small enough for a deformation.
  std::vector<double> inputs(static_cast<std::size_t>(signature.input_size(dim)));
  for (std::size_t i = 0; i < inputs.size(); ++i) inputs[i] = 0.05 + 0.01 * static_cast<double>(i % 7);
  PointBatch batch;
  batch.dimension = dim;
  batch.count = 1;
  batch.position = batch.partner_position = place.data();
  batch.normal = normal.data();
  batch.cell_size = batch.trace_size = batch.constant[0] = batch.constant[1] = batch.gap = one.data();
  batch.inputs = inputs.data();
  batch.step = 1;
  batch.level_factor = factors;
  const auto result = [&] {
    std::vector<double> values(static_cast<std::size_t>(signature.output_size(dim) + signature.values));
    term.evaluate(batch, values.data(), nullptr);
    return values;
  };
  try {
    const std::vector<double> before = result();
    for (std::size_t i = first; i < first + count; ++i) inputs[i] += 0.1;
    const std::vector<double> after = result();
    // No number differs from itself: of a kernel that is not at home at this point nothing is known.
    for (std::size_t i = 0; i < before.size(); ++i)
      if (before[i] < after[i] || before[i] > after[i]) return true;
  } catch (...) {
    return false;
  }
  return false;
}

void check_operand(const BoundTerm& bound, const IntegrationDomain& domain, std::size_t k, int components) {
  const Operand& operand = bound.operands[k];
  const Field& field = *domain.fields().at(operand.side);
  const Field::ComponentRange place = call_plugin(
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
  const int dim = fields.front()->mesh().dimension();
  const Signature& signature = bound.term->signature(dim);
  for (const Operand& operand : bound.operands)
    if (operand.side < 0 || operand.side >= static_cast<int>(fields.size()))
      throw PluginFault(bound.where,
                        fmt::format("a term on {}{} speaks of side {}; there are {}", domain.description(),
                                    plugin_of(*bound.term), operand.side, fields.size()));
  if (bound.operands.size() < signature.components.size())
    throw PluginFault(bound.where, fmt::format("{}: its kernel speaks of {} unknowns, but {} were given",
                                               describe(bound, domain), signature.components.size(),
                                               bound.operands.size()));
  if (signature.components.size() > most_operands)
    throw PluginFault(bound.where,
                      fmt::format("{}: its kernel speaks of {} unknowns; {} at most are possible",
                                  describe(bound, domain), signature.components.size(), most_operands));
  // A field may give all its unknowns to each of its terms; the same one twice is a slip.
  for (std::size_t k = signature.components.size(); k < bound.operands.size(); ++k)
    for (std::size_t other = 0; other < k; ++other)
      if (bound.operands[k].side == bound.operands[other].side &&
          bound.operands[k].unknown == bound.operands[other].unknown)
        throw PluginFault(bound.where,
                          fmt::format("{}: its kernel speaks of {} unknowns, but {} were given, '{}' twice",
                                      describe(bound, domain), signature.components.size(),
                                      bound.operands.size(), bound.operands[k].unknown));
  for (std::size_t k = 0; k < signature.components.size(); ++k)
    check_operand(bound, domain, k, signature.components[k]);
  std::size_t first = 0;
  for (const Slot& slot : signature.inputs) {
    const Operand& operand = bound.operands[slot.operand];
    const Field& field = *fields[operand.side];
    const Field::ComponentRange place = field.place(operand.unknown);
    const std::size_t size =
        static_cast<std::size_t>(signature.components[slot.operand]) * rows(slot.shape, dim);
    const int order = field.blocks()[place.block].time_order[place.offset];
    if (order < rate_order(slot.level) && depends_on(*bound.term, dim, first, size))
      throw PluginFault(
          bound.where,
          fmt::format("{}: it depends on a {}rate of '{}', which has none: its time_order is {}; declare at "
                      "least {} in the field's unknowns()",
                      describe(bound, domain), rate_order(slot.level) == 2 ? "second " : "", operand.unknown,
                      order, rate_order(slot.level)));
    first += size;
  }
}

}  // namespace seam
