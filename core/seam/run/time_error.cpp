// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/time_error.hpp"

#include <algorithm>
#include <cmath>

#include "seam/assembly/assembler.hpp"
#include "seam/cut/cut_mesh.hpp"
#include "seam/field/field.hpp"

namespace seam {
namespace {

constexpr double least_part = 0.1;  ///< of the largest state so far
/// Of what stands in the equations: an unknown with less is rounding, and so is its error.
constexpr double next_to_nothing = 1e-10;

/// Of a cell's volume, that a part of it has.
double share(const Field& field, int cell, int part) {
  if (!field.is_cut(cell) || field.cut()->state(cell) == CellState::wet) return 1;
  if (field.cut()->state(cell) == CellState::body) return 0;
  return field.cut()->wet_volume(cell, part) / field.cut()->cell_volume(cell);
}

/// Of the unknown whose components in the block start at `first`.
double time_error(const Field& field, int number, int first, int components, double step, double& largest) {
  const Block& block = field.blocks()[number];
  if (std::all_of(&block.time_order[first], &block.time_order[first] + components,
                  [](int order) { return order == 0; }))
    return 0;
  std::vector<double> sums(2, 0.0);
  for (int cell = 0; cell < field.mesh().owned_cells(); ++cell) {
    if (!field.active_cells()[cell]) continue;
    for (int part = 0; part < field.parts(cell); ++part) {
      const double weight = share(field, cell, part);
      const int* nodes = field.cell_nodes(number, cell, part);
      for (int k = 0; k < block.space->nodes_per_cell(); ++k)
        for (int c = first; c < first + components; ++c) {
          const std::size_t i = static_cast<std::size_t>(nodes[k]) * block.size + c;
          sums[0] += weight * std::pow(0.5 * step * (block.now.rate[i] - block.old.rate[i]), 2);
          sums[1] += weight * std::pow(block.now.value[i], 2);
        }
    }
  }
  field.mesh().communicator().sum(sums);
  const double size = std::sqrt(sums[1]);
  largest = std::max(largest, size);
  return largest > 0 ? std::sqrt(sums[0]) / std::max(size, least_part * largest) : 0.0;
}

/// Whether an unknown has a part in any kind of equations.
bool matters(const Assembler& assembler, const Block& block, int first, int components) {
  const std::vector<double> share = assembler.largest_by_kind(
      assembler.absolute_product([&](const Field&, const Block& of, int node, int c) {
        const bool is_of_it = &of == &block && c >= first && c < first + components;
        return is_of_it ? block.now.value[static_cast<std::size_t>(node) * block.size + c] : 0.0;
      }));
  const std::vector<double> all = assembler.largest_by_kind(assembler.magnitude());
  for (std::size_t kind = 0; kind < all.size(); ++kind)
    if (share[kind] > next_to_nothing * all[kind]) return true;
  return false;
}

}  // namespace

double time_error(Problem& problem, double step, std::vector<double>& largest) {
  double worst = 0;
  std::size_t number = 0;
  for (const FieldEntry& entry : problem.fields())
    // Each unknown by itself: they have units of their own.
    for (int b = 0; b < static_cast<int>(entry.field->blocks().size()); ++b)
      for (int first = 0; const int components : entry.field->blocks()[b].components) {
        const double error = time_error(*entry.field, b, first, components, step, largest[number++]);
        if (error > worst && matters(problem.assembler(), entry.field->blocks()[b], first, components))
          worst = error;
        first += components;
      }
  return worst;
}

}  // namespace seam
