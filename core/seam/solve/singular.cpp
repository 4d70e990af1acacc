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

/// A connected part of a field, and an unknown of it.
struct Part {
  const FieldEntry* entry;
  const Unknown* unknown;
  const ConnectedNodes* labels;
  int label;
  int block, first, components;  ///< where the unknown stands

  [[nodiscard]] bool holds(const Field& field, const Block& of, int node, int component) const {
    const int c = component - first;
    return &field == entry->field.get() && &of == &field.blocks()[block] && c >= 0 && c < components &&
           (*labels)[node] == label;
  }
  [[nodiscard]] bool is_vector() const { return components == entry->mesh->dimension(); }
};

/// A way in which a part, or several that are tied to each other, might change without resistance.
struct Mode {
  std::string name;  ///< "a translation in x"
  struct Share {
    const Part* part;
    std::function<double(const double* x, int component)> value;
  };
  std::vector<Share> shares;

  [[nodiscard]] double at(const Field& field, const Block& of, int node, int component) const {
    for (const Share& share : shares)
      if (share.part->holds(field, of, node, component))
        return share.value(of.space->position(node), component - share.part->first);
    return 0;
  }
};

using Change = std::function<double(const double*, int)>;

Change translation(int direction) {
  return [direction](const double*, int c) { return c == direction ? 1.0 : 0.0; };
}

Change rotation(int axis) {
  return [axis](const double* x, int c) {
    return c == (axis + 1) % 3 ? -x[(axis + 2) % 3] : c == (axis + 2) % 3 ? x[(axis + 1) % 3] : 0.0;
  };
}

/// Constants of an unknown's components and, of a vector, rotations.
void add_modes(const Part& part, std::vector<Mode>& modes) {
  const int dim = part.entry->mesh->dimension();
  static const char axis[] = "xyz";
  for (int d = 0; d < part.components; ++d)
    modes.push_back({part.is_vector() ? fmt::format("a translation in {}", axis[d]) : "a constant",
                     {{&part, translation(d)}}});
  if (!part.is_vector()) return;
  for (int r = dim == 2 ? 2 : 0; r < 3; ++r)
    modes.push_back({fmt::format("a rotation about {}", axis[r]), {{&part, rotation(r)}}});
}

/// The same of parts that are tied to each other: vectors move as one rigid body, in which bodies turn, and
/// single numbers change by a constant.
void add_modes(const std::vector<const Part*>& group, std::vector<Mode>& modes) {
  const int dim = group.front()->entry->mesh->dimension();
  static const char axis[] = "xyz";
  // What a rigid body turns by is tied together with what it is moved by.
  const auto is_turn = [&](const Part& part) {
    return part.entry->physics->support() == Support::point && part.unknown->role == UnknownRole::plain &&
           part.components == (dim == 2 ? 1 : 3) && part.unknown->unit == "rad";
  };
  if (std::ranges::any_of(group, [](const Part* part) { return part->is_vector(); })) {
    for (int d = 0; d < dim; ++d) {
      Mode& mode = modes.emplace_back(Mode{fmt::format("a translation in {}", axis[d]), {}});
      for (const Part* part : group)
        if (part->is_vector() && !is_turn(*part)) mode.shares.push_back({part, translation(d)});
    }
    for (int r = dim == 2 ? 2 : 0; r < 3; ++r) {
      Mode& mode = modes.emplace_back(Mode{fmt::format("a rotation about {}", axis[r]), {}});
      for (const Part* part : group)
        if (is_turn(*part))
          mode.shares.push_back({part, translation(dim == 2 ? 0 : r)});
        else if (part->is_vector())
          mode.shares.push_back({part, rotation(r)});
    }
    return;
  }
  Mode& mode = modes.emplace_back(Mode{"a constant", {}});
  for (const Part* part : group) mode.shares.push_back({part, translation(0)});
}

/// Parts of several fields that are tied to each other, directly or by others. Collective.
std::vector<std::vector<const Part*>> tied_groups(Problem& problem, const std::vector<Part>& parts) {
  std::vector<std::pair<const Field*, int>> blocks;  // by the numbers that ties know them by
  for (const FieldEntry& entry : problem.fields())
    for (std::size_t b = 0; b < entry.field->blocks().size(); ++b)
      blocks.emplace_back(entry.field.get(), static_cast<int>(b));
  const auto find = [&](const UnknownPlace& place) {
    const auto [field, number] = blocks[place.block];
    const Block& block = field->blocks()[number];
    const int node = block.space->local_node(place.node);
    if (node < 0) return -1;
    const auto found = std::ranges::find_if(
        parts, [&, &of = *field](const Part& part) { return part.holds(of, block, node, place.component); });
    return found == parts.end() ? -1 : static_cast<int>(found - parts.begin());
  };
  std::set<std::pair<int, int>> tied;
  for (const Ties::Resolved& tie : problem.assembler().ties())
    for (const TiedTo& to : tie.to) {
      if (to.unknown.is_clock()) continue;
      const int one = find(tie.unknown), two = find(to.unknown);
      if (one >= 0 && two >= 0) tied.emplace(one, two);
    }
  DisjointSets sets(static_cast<int>(parts.size()));
  const std::vector<std::pair<int, int>> own(tied.begin(), tied.end());
  for (const auto& [one, two] : problem.communicator().gather_all(own)) sets.unite(one, two);
  std::map<int, std::vector<const Part*>> groups;
  for (std::size_t k = 0; k < parts.size(); ++k) groups[sets.root(static_cast<int>(k))].push_back(&parts[k]);
  std::vector<std::vector<const Part*>> result;
  for (auto& [root, group] : groups)
    if (std::ranges::any_of(
            group, [first = group.front()->entry](const Part* part) { return part->entry != first; }))
      result.push_back(std::move(group));
  return result;
}

/// How much of what each mode does to each equation is left when it is added up: |K m| / (|K| |m|), the
/// largest of each by kinds of equations (components of a block), since these have units of their own; of the
/// kinds the one that resists most. Rounding leaves some 1e-16. Collective.
std::vector<double> resistances(Problem& problem, const std::vector<Mode>& modes) {
  const Assembler& assembler = problem.assembler();
  std::vector vectors(modes.size(), std::vector<double>(assembler.matrix().rows, 0.0));
  for (std::size_t m = 0; m < modes.size(); ++m) {
    for (const Mode::Share& share : modes[m].shares) {
      const Field& field = *share.part->entry->field;
      const Block& block = field.blocks()[share.part->block];
      for (int node = 0; node < block.space->owned_nodes(); ++node)
        for (int c = share.part->first; c < share.part->first + share.part->components; ++c) {
          if (!share.part->holds(field, block, node, c)) continue;
          // What is tied follows: its column acts through what it is tied to.
          const int row = assembler.row(field, share.part->block, node, c);
          if (row >= 0 && !assembler.is_tied(row))
            vectors[m][row] = share.value(block.space->position(node), c - share.part->first);
        }
    }
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
          const auto number = static_cast<int>(&block - field.blocks().data());
          const int row = assembler.row(field, number, node, c);
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

FreeModes describe_free_modes(Problem& problem, double resistance, bool levels_only) {
  std::list<ConnectedNodes> labels;
  std::vector<Part> parts;
  for (const FieldEntry& entry : problem.fields())
    for (const Unknown& unknown : entry.field->unknowns()) {
      const auto [block, offset, components] = entry.field->place(unknown.name);
      if (entry.field->blocks()[block].given || (levels_only && components > 1)) continue;
      labels.emplace_back(*entry.field, block);
      for (const int label : labels.back().parts())
        parts.push_back({&entry, &unknown, &labels.back(), label, block, offset, components});
    }
  std::vector<Mode> modes;
  for (const Part& part : parts) add_modes(part, modes);
  const std::size_t single = modes.size();
  for (const std::vector<const Part*>& group : tied_groups(problem, parts)) add_modes(group, modes);
  const std::vector<double> found = resistances(problem, modes);
  std::map<std::pair<const FieldEntry*, std::string>, std::set<std::string>> free;
  std::map<std::string, std::set<std::string>> free_together;  // by the names of the fields
  std::set<const FieldEntry*> named;
  for (std::size_t m = 0; m < modes.size(); ++m) {
    if (!(found[m] < resistance)) continue;
    if (m < single) {
      const Part& part = *modes[m].shares.front().part;
      free[{part.entry, part.unknown->name}].insert(modes[m].name);
      named.insert(part.entry);
      continue;
    }
    std::vector<std::string> fields;
    bool is_told = false;
    for (const Mode::Share& share : modes[m].shares) {
      is_told = is_told || named.contains(share.part->entry);
      const std::string name = fmt::format("'{}'", share.part->entry->name);
      if (std::ranges::find(fields, name) == fields.end()) fields.push_back(name);
    }
    if (!is_told) free_together[fmt::format("{}", fmt::join(fields, ", "))].insert(modes[m].name);
  }
  std::string text;
  for (const auto& [of, names] : free)
    text += fmt::format(
        "field '{}' is not held: its {} can change by {} without resistance; prescribe it somewhere, couple "
        "the field to another, or tie it to one ({})\n",
        of.first->name, of.second, fmt::join(names, ", "), how_to_tie);
  for (const auto& [fields, names] : free_together)
    text += fmt::format(
        "the fields {} are tied to each other, and nothing holds them together: they can change by {} "
        "without "
        "resistance; prescribe something of one of them, or couple one to another field\n",
        fields, fmt::join(names, ", "));
  for (const auto& [of, names] : free) text += describe_parts(*of.first);
  if (text.empty()) return {levels_only ? "" : describe_idle(problem)};
  return {text, free_together.empty() && std::ranges::all_of(free, [](const auto& of) {
                  return of.first.first->physics->support() == Support::point;
                })};
}

std::string describe_unsupported(Problem& problem, const std::vector<long long>& equations) {
  const Matrix& k = problem.assembler().matrix();
  std::string text = describe_free_modes(problem, 1e-10).text;
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
