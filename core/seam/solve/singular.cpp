// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <list>
#include <map>
#include <set>

#include "seam/assembly/assembler.hpp"
#include "seam/base/disjoint_sets.hpp"
#include "seam/solve/connected_nodes.hpp"
#include "seam/solve/newton.hpp"

namespace seam {
namespace {

/// A way in which a connected part of a field might change without resistance.
struct Mode {
  const FieldEntry* entry;
  const Block* block;
  std::string name;  ///< "a translation in x"
  std::string unknown;
  const ConnectedNodes* parts;
  int part;               ///< of these
  int first, components;  ///< of the unknown within the block
  std::function<double(const double* x, int component)> value;

  [[nodiscard]] double at(const Field& field, const Block& of, int node, int component) const {
    const int c = component - first;
    if (&field != entry->field.get() || &of != block || c < 0 || c >= components || (*parts)[node] != part)
      return 0;
    return value(block->space->position(node), c);
  }
};

/// Constants of an unknown's components and, of a vector, rotations.
void add_modes(const FieldEntry& entry, const Unknown& unknown, const ConnectedNodes& parts, int part,
               std::vector<Mode>& modes) {
  const Field::ComponentRange place = entry.field->place(unknown.name);
  const Block& block = entry.field->blocks()[place.block];
  const int dim = entry.mesh->dimension();
  const bool vector = place.components == dim;
  static const char axis[] = "xyz";
  const auto add = [&](const std::string& name, std::function<double(const double*, int)> value) {
    modes.push_back(
        {&entry, &block, name, unknown.name, &parts, part, place.offset, place.components, std::move(value)});
  };
  for (int d = 0; d < place.components; ++d)
    add(vector ? fmt::format("a translation in {}", axis[d]) : "a constant",
        [d](const double*, int c) { return c == d ? 1.0 : 0.0; });
  if (!vector) return;
  for (int r = dim == 2 ? 2 : 0; r < 3; ++r)
    add(fmt::format("a rotation about {}", axis[r]), [r](const double* x, int c) {
      return c == (r + 1) % 3 ? -x[(r + 2) % 3] : c == (r + 2) % 3 ? x[(r + 1) % 3] : 0.0;
    });
}

/// How much of what each mode does to each equation is left when it is added up: |K m| / (|K| |m|), the
/// largest of each by kinds of equations (components of a block), since these have units of their own; of the
/// kinds the one that resists most. Rounding leaves some 1e-16. Collective.
std::vector<double> resistances(Problem& problem, const std::vector<Mode>& modes) {
  const Assembler& assembler = problem.assembler();
  std::vector vectors(modes.size(), std::vector<double>(assembler.matrix().rows, 0.0));
  for (std::size_t m = 0; m < modes.size(); ++m) {
    const Field& field = *modes[m].entry->field;
    const Block& block = *modes[m].block;
    const int number = field.place(modes[m].unknown).block;
    for (int node = 0; node < block.space->owned_nodes(); ++node)
      for (int c = 0; c < block.size; ++c)
        // What is tied follows: its column acts through what it is tied to.
        if (const int row = assembler.row(field, number, node, c); row >= 0 && !assembler.is_tied(row))
          vectors[m][row] = modes[m].at(field, block, node, c);
  }
  const std::vector<std::vector<double>> products = multiply(assembler.matrix(), vectors);
  std::vector<double> result(modes.size(), 0.0);
  const auto moves = [&](const std::vector<double>& mode) {
    return problem.communicator().any(std::ranges::any_of(mode, [](double v) { return v != 0; }));
  };
  for (std::size_t m = 0; m < modes.size(); ++m) {
    if (!moves(vectors[m])) {  // all of it is tied: it is what it is tied to that may be free
      result[m] = 1;
      continue;
    }
    const std::vector<double> left = assembler.largest_by_kind(products[m]);
    const std::vector<double> size = assembler.largest_by_kind(
        assembler.absolute_product([&](const Field& field, const Block& block, int node, int c) {
          const double change = modes[m].at(field, block, node, c);
          if (change == 0) return change;
          const int row = assembler.row(field, field.place(modes[m].unknown).block, node, c);
          return row >= 0 && assembler.is_tied(row) ? 0.0 : change;
        }));
    for (std::size_t kind = 0; kind < left.size(); ++kind)
      if (size[kind] > 0) result[m] = std::max(result[m], left[kind] / size[kind]);
  }
  return result;
}

constexpr const char* how_to_tie = "`constraints`, as {type: rigid} ties a `rigid_surface` to its body";

/// Unknowns of which no equation speaks at some nodes, though something holds the field: a surface whose body
/// it does not follow, in a flow. Collective.
std::string describe_idle(Problem& problem) {
  const Assembler& assembler = problem.assembler();
  const Matrix& k = assembler.matrix();
  std::string text;
  for (const FieldEntry& entry : problem.fields())
    for (const Unknown& unknown : entry.field->unknowns()) {
      const auto [number, offset, components] = entry.field->place(unknown.name);
      if (entry.field->blocks()[number].given) continue;
      const Space& space = *entry.field->blocks()[number].space;
      std::vector<std::array<double, 3>> idle;  // positions
      for (int node = 0; node < space.owned_nodes(); ++node)
        for (int c = offset; c < offset + components; ++c) {
          const int row = assembler.row(*entry.field, number, node, c);
          if (row < 0 || std::any_of(k.value.begin() + k.row_start[row],
                                     k.value.begin() + k.row_start[row + 1], [](double v) { return v != 0; }))
            continue;
          std::copy_n(space.position(node), entry.mesh->dimension(), idle.emplace_back().begin());
          break;
        }
      idle = problem.communicator().gather_all(idle);
      if (idle.empty()) continue;
      text += fmt::format(
          "field '{}': nothing resists at {} of its nodes if its {} changes there, as at ({:.6g}); couple or "
          "tie it there ({})\n",
          entry.name, idle.size(), unknown.name,
          fmt::join(idle.front().begin(), idle.front().begin() + entry.mesh->dimension(), ", "), how_to_tie);
    }
  return text;
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

std::string describe_free_modes(Problem& problem, double resistance, bool levels_only) {
  std::list<ConnectedNodes> parts;
  std::vector<Mode> modes;
  for (const FieldEntry& entry : problem.fields())
    for (const Unknown& unknown : entry.field->unknowns()) {
      const auto [block, offset, components] = entry.field->place(unknown.name);
      if (entry.field->blocks()[block].given || (levels_only && components > 1)) continue;
      parts.emplace_back(*entry.field, block);
      for (const int part : parts.back().parts()) add_modes(entry, unknown, parts.back(), part, modes);
    }
  const std::vector<double> found = resistances(problem, modes);
  std::map<std::pair<const FieldEntry*, std::string>, std::set<std::string>> free;
  for (std::size_t m = 0; m < modes.size(); ++m)
    if (found[m] < resistance) free[{modes[m].entry, modes[m].unknown}].insert(modes[m].name);
  std::string text;
  for (const auto& [of, names] : free)
    text += fmt::format(
        "field '{}' is not held: its {} can change by {} without resistance; prescribe it somewhere, couple "
        "the field to another, or tie it to one ({})\n",
        of.first->name, of.second, fmt::join(names, ", "), how_to_tie);
  for (const auto& [of, names] : free) text += describe_parts(*of.first);
  return text.empty() && !levels_only ? describe_idle(problem) : text;
}

std::string describe_unsupported(Problem& problem, const std::vector<long long>& equations) {
  const Matrix& k = problem.assembler().matrix();
  std::string text = describe_free_modes(problem, 1e-10);
  if (!text.empty() || equations.empty()) return text;
  for (const EquationBlock& block : problem.assembler().equation_blocks())
    for (const EquationUnknown& unknown : block.unknowns)
      for (const long long equation : equations) {
        const auto found = std::ranges::find(unknown.rows, equation - k.first_row);
        if (found == unknown.rows.end()) continue;
        const auto node = (found - unknown.rows.begin()) / unknown.components;
        const double* x = &unknown.coordinates[static_cast<std::size_t>(node) * block.dimension];
        text += fmt::format("field '{}': nothing resists at its node at ({}) if its {} changes there\n",
                            block.field, fmt::join(x, x + block.dimension, ", "), unknown.name);
        break;
      }
  for (const FieldEntry& entry : problem.fields()) text += describe_parts(entry);
  return text;
}

}  // namespace seam
