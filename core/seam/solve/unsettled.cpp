// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/unsettled.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "seam/assembly/assembler.hpp"
#include "seam/field/field.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

std::string describe_pending(Problem& problem, const TimePoint& at) {
  constexpr double enough = 1e-10;
  struct Way {
    double part, way;
    int entry, unknown, component;
    double at[3];
  };
  struct Place {
    int entry;
    Block* block;
    int number;
  };
  std::vector<Place> blocks;
  for (int e = 0; e < static_cast<int>(problem.fields().size()); ++e) {
    std::vector<Block>& own = problem.fields()[e].field->blocks();
    for (int b = 0; b < static_cast<int>(own.size()); ++b) blocks.push_back({e, &own[b], b});
  }
  const auto value = [&](const UnknownPlace& of) {
    const Block& block = *blocks[of.block].block;
    return block.now
        .value[static_cast<std::size_t>(block.space->local_node(of.node)) * block.size + of.component];
  };
  const auto is_here = [&](const UnknownPlace& of) {
    return of.is_clock() || blocks[of.block].block->space->local_node(of.node) >= 0;
  };
  std::vector<Way> farthest;
  for (const Ties::Resolved& tie : problem.ties(at)) {
    // Each rank has what its own unknowns are tied to; of others' ties it need not.
    if (!is_here(tie.unknown) ||
        !std::ranges::all_of(tie.to, [&](const TiedTo& to) { return is_here(to.unknown); }))
      continue;
    const Place& place = blocks[tie.unknown.block];
    const FieldEntry& entry = problem.fields()[place.entry];
    Way way{0, tie.constant - value(tie.unknown), place.entry, 0, 0, {}};
    double size = std::abs(tie.constant);
    for (int u = 0; u < static_cast<int>(entry.field->unknowns().size()); ++u) {
      const Unknown& unknown = entry.field->unknowns()[u];
      const Field::ComponentRange range = entry.field->place(unknown.name);
      const int component = tie.unknown.component - range.offset;
      if (range.block != place.number || component < 0 || component >= range.components) continue;
      way.unknown = u;
      way.component = range.components == entry.mesh->dimension() ? component : -1;
      size = std::max(size, unknown.scale);
    }
    for (const TiedTo& to : tie.to) {
      if (to.unknown.is_clock()) continue;
      way.way += to.coefficient * value(to.unknown);
      size = std::max(size, std::abs(to.coefficient * value(to.unknown)));
    }
    way.part = std::abs(way.way) / size;
    std::copy_n(tie.unknown.position, 3, way.at);
    if (way.part > enough && (farthest.empty() || way.part > farthest.front().part)) farthest.assign(1, way);
  }
  farthest = problem.communicator().gather_all(farthest);
  if (farthest.empty()) return "";
  const Way& worst = *std::ranges::max_element(farthest, {}, &Way::part);
  const FieldEntry& entry = problem.fields()[worst.entry];
  const Unknown& unknown = entry.field->unknowns()[worst.unknown];
  return fmt::format("'{}'{} of field '{}' at ({:.6g}) is {:.3g} {} from where it is tied to", unknown.name,
                     worst.component < 0 ? "" : fmt::format(" in {}", "xyz"[worst.component]), entry.name,
                     fmt::join(worst.at, worst.at + entry.mesh->dimension(), ", "), std::abs(worst.way),
                     unknown.unit);
}

std::string describe_largest_residual(const Problem& problem, const std::string& unknown) {
  struct Largest {
    double residual;
    double at[3];
  };
  std::vector<Largest> largest;
  const Assembler& assembler = problem.assembler();
  int dimension = 0;
  for (const FieldEntry& entry : problem.fields()) {
    if (!unknown.starts_with(entry.name + ".")) continue;
    const auto of =
        std::ranges::find(entry.field->unknowns(), unknown.substr(entry.name.size() + 1), &Unknown::name);
    if (of == entry.field->unknowns().end()) continue;
    dimension = entry.mesh->dimension();
    const Field::ComponentRange place = entry.field->place(of->name);
    const Block& block = entry.field->blocks()[place.block];
    for (int node = 0; node < block.space->owned_nodes(); ++node) {
      const int row = assembler.row(*entry.field, place.block, node, place.offset);
      for (int c = 0; c < place.components && row >= 0; ++c) {
        const double residual = std::abs(assembler.residual()[row + c]);
        if (!largest.empty() && residual <= largest.front().residual) continue;
        largest.resize(1);
        largest.front().residual = residual;
        std::copy_n(block.space->position(node), dimension, largest.front().at);
      }
    }
  }
  largest = problem.communicator().gather_all(largest);
  if (largest.empty()) return "";
  const Largest& most = *std::ranges::max_element(largest, {}, &Largest::residual);
  return fmt::format(", the most at rest at ({:.6g})", fmt::join(most.at, most.at + dimension, ", "));
}

}  // namespace seam
