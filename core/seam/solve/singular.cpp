// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "seam/base/disjoint_sets.hpp"
#include "seam/solve/newton.hpp"

namespace seam {
namespace {

/// |K m| / (|K| |m|), where |K| is measured by the largest entries of the mode's rows. All rows count that
/// resist: those of a velocity hold a pressure at an outflow.
double resistance(const Problem& problem, const Matrix& k, const std::vector<double>& mode) {
  std::vector<double> product;
  multiply(k, mode, product);
  double force = 0, scale = 0;
  for (int r = 0; r < k.rows; ++r) {
    force += product[r] * product[r];
    if (mode[r] == 0) continue;
    double largest = 0;
    for (std::size_t e = k.row_start[r]; e < k.row_start[r + 1]; ++e)
      largest = std::max(largest, std::abs(k.value[e]));
    scale += largest * largest * mode[r] * mode[r];
  }
  std::vector<double> sums{force, scale};
  problem.communicator().sum(sums);
  return sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : 0.0;
}

/// Modes an unknown can have without resistance: a constant in each component and, for a vector, rotations.
std::vector<std::pair<std::string, std::vector<double>>> candidate_modes(Problem& problem,
                                                                         const FieldEntry& entry,
                                                                         const Unknown& unknown) {
  Assembler& assembler = problem.assembler();
  const Field::Place place = entry.field->place(unknown.name);
  const Block& block = entry.field->blocks()[place.block];
  const int dim = entry.mesh->dimension();
  const bool vector = place.components == dim;
  std::vector<std::pair<std::string, std::vector<double>>> modes;
  const auto fill = [&](const std::string& name, const std::function<double(const double*, int)>& value) {
    auto& mode = modes.emplace_back(name, std::vector<double>(assembler.matrix().rows, 0.0)).second;
    for (int node = 0; node < block.space->owned_nodes(); ++node)
      for (int c = 0; c < place.components; ++c) {
        const int row = assembler.row(*entry.field, place.block, node, place.offset + c);
        if (row >= 0) mode[row] = value(block.space->position(node), c);
      }
  };
  static const char axis[] = "xyz";
  for (int d = 0; d < place.components; ++d)
    fill(vector ? fmt::format("a translation in {}", axis[d]) : "a constant",
         [d](const double*, int c) { return c == d ? 1.0 : 0.0; });
  if (!vector) return modes;
  for (int r = dim == 2 ? 2 : 0; r < 3; ++r)
    fill(fmt::format("a rotation about {}", axis[r]), [r](const double* x, int c) {
      return c == (r + 1) % 3 ? -x[(r + 2) % 3] : c == (r + 2) % 3 ? x[(r + 1) % 3] : 0.0;
    });
  return modes;
}

/// How many parts a mesh has that share no node.
int count_parts(const MeshData& mesh) {
  DisjointSets sets(mesh.node_count());
  const int per_cell = mesh.nodes_per_cell();
  std::vector<char> used(mesh.node_count(), 0);
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int k = 0; k < per_cell; ++k) {
      const int* nodes = &mesh.cells[static_cast<std::size_t>(c) * per_cell];
      used[nodes[k]] = 1;
      sets.unite(nodes[k], nodes[0]);
    }
  int parts = 0;
  for (int n = 0; n < mesh.node_count(); ++n) parts += used[n] != 0 && sets.root(n) == n ? 1 : 0;
  return parts;
}

/// A line about a field whose mesh falls apart; "" where it does not.
std::string describe_parts(const FieldEntry& entry) {
  const int parts = count_parts(entry.mesh->whole());
  if (parts < 2) return "";
  return fmt::format(
      "the mesh '{}' of field '{}' has {} parts that share no node: each of them has to be held, or coupled "
      "to "
      "something\n",
      entry.mesh->name(), entry.name, parts);
}

}  // namespace

std::string describe_unsupported(Problem& problem, const std::vector<long long>& equations) {
  const Matrix& k = problem.assembler().matrix();
  std::string text;
  for (const FieldEntry& entry : problem.fields())
    for (const Unknown& unknown : entry.field->unknowns()) {
      std::vector<std::string> free;
      for (const auto& [name, mode] : candidate_modes(problem, entry, unknown))
        if (resistance(problem, k, mode) < 1e-10) free.push_back(name);
      if (!free.empty())
        text += fmt::format(
            "field '{}' is not held: its {} can change by {} without resistance; prescribe it somewhere "
            "or couple the field to another\n",
            entry.name, unknown.name, fmt::join(free, ", "));
    }
  if (!text.empty() || equations.empty()) return text;
  for (const EquationBlock& block : problem.assembler().equation_blocks())
    for (const long long equation : equations) {
      const long long local = equation - k.first_row - block.first;
      if (local < 0 || local >= block.count) continue;
      const double* x =
          &block.coordinates[static_cast<std::size_t>(local / block.unknowns_per_node) * block.dimension];
      text += fmt::format("field '{}' has no resistance at its node at ({})\n", block.field,
                          fmt::join(x, x + block.dimension, ", "));
      break;
    }
  for (const FieldEntry& entry : problem.fields()) text += describe_parts(entry);
  return text;
}

}  // namespace seam
