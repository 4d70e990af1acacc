// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/multipliers.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "seam/assembly/element.hpp"
#include "seam/field/field.hpp"
#include "seam/field/surface_nodes.hpp"

namespace seam {
namespace {

/// A multiplier is left out where less of each of its faces has something opposite, by this factor, than of a
/// face of one beside it: what so little holds grows with the inverse square of it.
constexpr double hardly_covered = 0.75;

/// A multiplier on a surface.
struct Multiplier {
  const Unknown& unknown;
  int number;  ///< of its block
  const Block& block;
};

template <class Use>
void for_each_multiplier(const Field& field, const Use& use) {
  for (const Unknown& unknown : field.unknowns()) {
    if (!unknown.boundaries || unknown.multiplier_of.empty()) continue;
    const int number = field.place(unknown.name).block;
    use(Multiplier{unknown, number, field.blocks()[number]});
  }
}

/// Elements of interfaces whose first side is the field. @param use is told the domain, the element and its
/// number
template <class Use>
void for_each_element(const Interfaces& interfaces, const Field& field, const std::string& of,
                      const Use& use) {
  Element element;
  for (const auto& [name, parts] : interfaces) {
    if (!of.starts_with(name + ".")) continue;
    for (const InterfacePart& part : parts) {
      if (part.domain->fields().front() != &field) continue;
      for (int e = 0; e < part.domain->size(); ++e) {
        part.domain->fill(e, element);
        use(*part.domain, e, element);
      }
    }
  }
}

/// Whether a node's function vanishes at all points of an element, as that of one beside its face.
bool vanishes(const Element& element, int order, int node, int side = 0) {
  const ShapeTable& table = *element.sides[side].table[order - 1];
  for (int q = 0; q < element.points; ++q)
    if (std::abs(table.value[static_cast<std::size_t>(q) * table.stride + node]) > 1e-14) return false;
  return true;
}

/// The face on which an element's points lie: functions of the other vertices vanish there. @param order of
/// functions that are known there
int face_of(const CellTopology& cell, const Element& element, int order) {
  const ShapeTable& table = *element.sides[0].table[order - 1];
  int found = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int f = 0; f < static_cast<int>(cell.faces.size()); ++f) {
    double most = 0;
    for (int v = 0; v < cell.vertices; ++v)
      for (int q = 0; q < element.points && std::ranges::count(cell.faces[f], v) == 0; ++q)
        most = std::max(most, std::abs(table.value[static_cast<std::size_t>(q) * table.stride + v]));
    if (most >= least) continue;
    least = most;
    found = f;
  }
  return found;
}

/// The part of one of a node's faces that has something opposite, of the face of which it is the most, and
/// the most that this is of a node on one of these.
struct Cover {
  double part = 0, beside = 0;
};

/// By global node. Collective.
std::map<int, Cover> covered(const Interfaces& interfaces, const Field& field, const Multiplier& of) {
  const CellTopology& cell = topology(field.mesh().type());
  const Space& space = *of.block.space;
  const int per_face = topology(cell.face_type).nodes(space.order());
  std::map<std::vector<int>, double> part_of_face;  // by its nodes; all elements of a face are on one rank
  for_each_element(interfaces, field, of.unknown.name,
                   [&](const IntegrationDomain& domain, int e, const Element& element) {
                     const int face = face_of(cell, element, space.order());
                     const int* nodes = domain.nodes(e, 0, of.number);
                     std::vector<int> own;
                     for (int a = 0; a < per_face; ++a)
                       own.push_back(space.global_node(nodes[cell.face_nodes[face][a]]));
                     part_of_face[own] += std::accumulate(element.weight.begin(), element.weight.end(), 0.0) /
                                          face_area(cell, face, element.sides[0].geometry);
                   });
  struct Part {
    int node;
    double part;
  };
  std::map<int, Cover> result;
  const auto spread = [&](double Cover::*to, const auto& of_face) {
    std::vector<Part> own;
    for (const auto& [nodes, part] : part_of_face)
      for (const int node : nodes) own.push_back({node, of_face(nodes, part)});
    for (const Part& one : field.mesh().communicator().gather_all(own))
      result[one.node].*to = std::max(result[one.node].*to, one.part);
  };
  spread(&Cover::part, [](const std::vector<int>&, double part) { return part; });
  spread(&Cover::beside, [&](const std::vector<int>& nodes, double) {
    double most = 0;
    for (const int node : nodes) most = std::max(most, result.at(node).part);
    return most;
  });
  return result;
}

/// Whether it holds every component of what it holds.
bool holds_all(const Field& field, const Unknown& multiplier) {
  return multiplier.components == field.place(multiplier.multiplier_of).components;
}

/// Nodes of a field that multipliers on the surface opposite hold, by block and global node. Collective.
std::set<std::pair<int, int>> held_from_opposite(const Interfaces& interfaces, const Field& field) {
  struct Node {
    int block, node;
  };
  const auto looks_at_it = [&](const IntegrationDomain& domain) {
    const std::vector<Field*> fields = domain.fields();
    return fields.size() == 2 && fields[1] == &field;
  };
  std::set<const Field*> opposite;
  for (const auto& [name, parts] : interfaces)
    for (const InterfacePart& part : parts)
      if (looks_at_it(*part.domain)) opposite.insert(part.domain->fields()[0]);
  std::vector<Node> own;
  for (const Field* other : opposite)
    for_each_multiplier(*other, [&](const Multiplier& of) {
      if (!holds_all(*other, of.unknown)) return;
      const int number = field.place(of.unknown.multiplier_of).block;
      const Space& space = *field.blocks()[number].space;
      for_each_element(interfaces, *other, of.unknown.name,
                       [&](const IntegrationDomain& domain, int e, const Element& element) {
                         if (!looks_at_it(domain)) return;
                         const int* nodes = domain.nodes(e, 1, number);
                         for (int a = 0; a < space.nodes_per_cell(); ++a)
                           if (!vanishes(element, space.order(), a, 1))
                             own.push_back({number, space.global_node(nodes[a])});
                       });
    });
  std::set<std::pair<int, int>> result;
  for (const Node& node : field.mesh().communicator().gather_all(own)) result.emplace(node.block, node.node);
  return result;
}

/// Of what a field's multipliers hold, where it is given already.
class Given {
 public:
  /// @param tied of the field: block and global node
  Given(const Field& field, std::set<std::pair<int, int>> tied, const Interfaces& interfaces)
      : field_(field), tied_(std::move(tied)), interfaces_(interfaces) {
    // Where joints meet, one of them is left to the others: around a point all of them would hold the same
    // twice.
    tied_.merge(held_from_opposite(interfaces, field));
    for_each_multiplier(field, [&](const Multiplier& of) {
      if (!holds_all(field, of.unknown)) return;
      for (int node = 0; node < of.block.space->owned_nodes(); ++node)
        if (of.block.surface_share[node] > 0)
          holders_[{of.unknown.multiplier_of, of.block.space->global_node(node)}].insert(of.number);
    });
  }
  /// @param node owned
  [[nodiscard]] bool holds(const Multiplier& of, int node) const {
    const Field::ComponentRange held = field_.place(of.unknown.multiplier_of);
    const Block& motion = field_.blocks()[held.block];
    const int global = of.block.space->global_node(node), there = motion.space->local_node(global);
    int given = 0;
    for (int c = held.offset; c < held.offset + held.components && there >= 0; ++c)
      given += motion.prescribed[static_cast<std::size_t>(there) * motion.size + c] != 0 ? 1 : 0;
    // One component of a direction that is not known beforehand: it is given if all are, and against what is
    // given.
    if (!holds_all(field_, of.unknown)) return given == held.components && is_on_obstacle(of.unknown.name);
    return given > 0 || tied_.contains({held.block, global}) ||
           holders_.at({of.unknown.multiplier_of, global}).size() > 1;
  }

 private:
  [[nodiscard]] bool is_on_obstacle(const std::string& unknown) const {
    return std::ranges::any_of(interfaces_, [&](const auto& entry) {
      return unknown.starts_with(entry.first + ".") && entry.second.front().domain->fields().size() == 1;
    });
  }
  const Field& field_;
  std::set<std::pair<int, int>> tied_;
  const Interfaces& interfaces_;
  std::map<std::pair<std::string, int>, std::set<int>> holders_;  ///< by unknown and global node: blocks
};

void leave_out(Field& field, const Given& given, const Interfaces& interfaces) {
  std::map<int, std::vector<int>> nodes;  // by block
  for_each_multiplier(field, [&](const Multiplier& of) {
    // Contact sees now this, now that.
    const std::map<int, Cover> reached =
        holds_all(field, of.unknown) ? covered(interfaces, field, of) : std::map<int, Cover>{};
    for (int node = 0; node < of.block.space->owned_nodes(); ++node) {
      if (of.block.surface_share[node] == 0) continue;
      const auto at = reached.find(of.block.space->global_node(node));
      const bool ends_opposite = at != reached.end() && at->second.part < hardly_covered * at->second.beside;
      if (ends_opposite || given.holds(of, node)) nodes[of.number].push_back(node);
    }
  });
  for (std::size_t b = 0; b < field.blocks().size(); ++b)
    if (field.blocks()[b].boundaries) field.leave_out(static_cast<int>(b), nodes[static_cast<int>(b)]);
}

}  // namespace

void leave_out_multipliers(const std::vector<Field*>& fields, const std::vector<Ties::Resolved>& ties,
                           const Interfaces& interfaces) {
  int first = 0;  // number of a field's first block among those of all
  for (Field* field : fields) {
    const int count = static_cast<int>(field->blocks().size());
    std::set<std::pair<int, int>> tied;
    for (const Ties::Resolved& tie : ties)
      if (tie.unknown.block >= first && tie.unknown.block < first + count)
        tied.emplace(tie.unknown.block - first, tie.unknown.node);
    leave_out(*field, Given(*field, std::move(tied), interfaces), interfaces);
    first += count;
  }
}

std::string describe_lost_multipliers(const Field& field, const Interfaces& interfaces) {
  struct Place {
    int unknown;
    double at[3];
  };
  std::vector<Place> lost;
  for_each_multiplier(field, [&](const Multiplier& of) {
    if (!holds_all(field, of.unknown)) return;
    for_each_element(interfaces, field, of.unknown.name,
                     [&](const IntegrationDomain& domain, int e, const Element& element) {
                       const int* nodes = domain.nodes(e, 0, of.number);
                       bool is_kept = !lost.empty();
                       for (int a = 0; a < of.block.space->nodes_per_cell() && !is_kept; ++a)
                         is_kept = of.block.left_out[nodes[a]] == 0 &&
                                   !vanishes(element, of.block.space->order(), a);
                       if (is_kept) return;
                       Place& place = lost.emplace_back();
                       place.unknown = static_cast<int>(&of.unknown - field.unknowns().data());
                       std::copy_n(element.sides[0].position.begin(), field.mesh().dimension(), place.at);
                     });
  });
  lost = field.mesh().communicator().gather_all(lost);
  if (lost.empty()) return "";
  const Unknown& unknown = field.unknowns()[lost.front().unknown];
  return fmt::format(
      "nothing is left of '{}' on the face of field '{}' at ({:.6g}): at each of its nodes the {} is "
      "prescribed or tied, or two "
      "interfaces meet, or next to nothing is opposite. Let the other field come first in `fields` of the "
      "interface, or refine the mesh there",
      unknown.name, field.name(),
      fmt::join(lost.front().at, lost.front().at + field.mesh().dimension(), ", "), unknown.multiplier_of);
}

}  // namespace seam
