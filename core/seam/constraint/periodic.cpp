// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "seam/base/disjoint_sets.hpp"
#include "seam/constraint/constraint.hpp"
#include "seam/constraint/node_selection.hpp"
#include "seam/constraint/types.hpp"
#include "seam/constraint/watches_cut.hpp"
#include "seam/cut/cut_mesh.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/plugin/registry.hpp"

namespace seam {
namespace {

/// A node as all ranks know it.
struct SharedNode {
  int global, owner;
  double position[3];
};

/// What a field has on one boundary continues on another one, a translation away.
class Periodic final : public Constraint, public WatchesCut {
 public:
  explicit Periodic(const Parameters& p)
      : where_(p.where()),
        name_(p.text("field")),
        boundaries_(p.names("boundaries")),
        unknowns_(p.names("unknowns")) {
    if (boundaries_.empty() || boundaries_.size() % 2 != 0)
      throw Error(p.where("boundaries"),
                  fmt::format("found {} boundaries, expected pairs of opposite ones: [x_min, x_max]",
                              boundaries_.size()));
    for (auto one = boundaries_.begin(); one != boundaries_.end(); ++one)
      if (std::find(boundaries_.begin(), one, *one) != one)
        throw Error(p.where("boundaries"),
                    fmt::format("boundary '{}' stands here twice; each continues on one other boundary: "
                                "[x_min, x_max]",
                                *one));
  }

  void build(ConstraintSetup& setup) override {
    field_ = &setup.field(name_);
    if (field_->sets() > 1)
      throw Error(where_,
                  fmt::format("field '{}' keeps parts of its cells apart (`parts: separate`): which of "
                              "them continue on the other side is not known; take it without",
                              name_));
    for (const std::string& boundary : boundaries_) setup.close(*field_, boundary);
    for (std::size_t b = 0; b < field_->blocks().size(); ++b) {
      const int block = static_cast<int>(b);
      const std::vector<int> components = components_of(*field_, block, unknowns_);
      if (components.empty()) continue;
      const TiedBlock& of = blocks_.emplace_back(TiedBlock{block, components, classes_of(setup, block)});
      std::vector<std::vector<int>> groups;
      for (const Class& nodes : of.classes) {
        groups.emplace_back();
        for (const SharedNode& node : nodes) groups.back().push_back(node.global);
      }
      field_->join(block, std::move(groups));
    }
  }

  void look_at_cut(const TimePoint& at) const override {
    if (field_->cut() == nullptr) return;
    for (std::size_t k = 0; k < boundaries_.size(); k += 2) require_same_wet(k, at);
  }

  void tie(Ties& ties, const TimePoint&) const override {
    for (const TiedBlock& of : blocks_) tie_block(ties, of);
  }

 private:
  /// A face of a boundary, by its middle, and how much of it no body covers.
  struct WetFace {
    double middle[3];
    double area, wet;
  };

  [[nodiscard]] std::vector<WetFace> wet_faces(const std::string& boundary) const {
    const Mesh& mesh = field_->mesh();
    const int dim = mesh.dimension();
    std::vector<WetFace> own;
    CutRule rule;
    for (const CellFace& face : mesh.boundary(boundary)) {
      if (face.cell >= mesh.owned_cells()) continue;
      const std::vector<int>& corners = topology(mesh.type()).faces[face.face];
      std::vector<std::array<double, 3>> x(corners.size());
      WetFace& of = own.emplace_back(WetFace{{}, 0, 0});
      for (std::size_t a = 0; a < corners.size(); ++a)
        for (int d = 0; d < dim; ++d) {
          x[a][d] = mesh.geometry(face.cell)[corners[a] * dim + d];
          of.middle[d] += x[a][d] / static_cast<double>(corners.size());
        }
      of.area = area_of(x);
      if (!field_->active_cells()[face.cell]) continue;
      of.wet = of.area;
      if (!field_->is_cut(face.cell)) continue;
      field_->cut()->face_rule(face.cell, face.face, 1, rule);
      of.wet = std::accumulate(rule.weight.begin(), rule.weight.end(), 0.0);
    }
    return mesh.communicator().gather_all(own);
  }

  /// Of a segment, a triangle, or a plane quadrilateral.
  [[nodiscard]] static double area_of(const std::vector<std::array<double, 3>>& x) {
    const auto way = [&](std::size_t from, std::size_t to) {
      return std::array<double, 3>{x[to][0] - x[from][0], x[to][1] - x[from][1], x[to][2] - x[from][2]};
    };
    if (x.size() == 2) return std::hypot(way(0, 1)[0], way(0, 1)[1]);
    const auto a = x.size() == 3 ? way(0, 1) : way(0, 2), b = x.size() == 3 ? way(0, 2) : way(1, 3);
    return 0.5 * std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
  }

  /// A body that reaches over a boundary ends there, and the field goes on where the rest of it should be.
  /// @throws Error at the start, StepRefused in a step where a body covers one side and not the other
  void require_same_wet(std::size_t pair, const TimePoint& at) const {
    constexpr double rounding = 1e-6;  // of a face
    const int dim = field_->mesh().dimension();
    const std::vector<WetFace> first = wet_faces(boundaries_[pair]),
                               second = wet_faces(boundaries_[pair + 1]);
    double shift[3] = {};
    for (int d = 0; d < dim; ++d) {
      for (const WetFace& face : second) shift[d] += face.middle[d] / static_cast<double>(second.size());
      for (const WetFace& face : first) shift[d] -= face.middle[d] / static_cast<double>(first.size());
    }
    const auto distance = [&](const WetFace& a, const WetFace& b) {
      double square = 0;
      for (int d = 0; d < dim; ++d) square += std::pow(b.middle[d] - a.middle[d] - shift[d], 2);
      return square;
    };
    // Where bodies are on neither side there is nothing to look for.
    const auto look = [&](const std::vector<WetFace>& faces, const std::vector<WetFace>& others,
                          bool turned) {
      for (const WetFace& face : faces) {
        if (face.area - face.wet <= rounding * face.area) continue;
        const WetFace& other = *std::ranges::min_element(
            others, {}, [&](const WetFace& of) { return turned ? distance(of, face) : distance(face, of); });
        if (other.wet - face.wet <= rounding * face.area) continue;
        const std::string message = fmt::format(
            "a body reaches over the periodic boundary '{}' of field '{}' at ({:.6g}), and nothing covers "
            "the "
            "place on '{}' where it would go on: keep bodies within the mesh, or let another one stand for "
            "the part beyond",
            boundaries_[pair + (turned ? 1 : 0)], name_, fmt::join(face.middle, face.middle + dim, ", "),
            boundaries_[pair + (turned ? 0 : 1)]);
        if (at.step > 0) throw StepRefused(message);
        throw Error(where_, message);
      }
    };
    look(first, second, false);
    look(second, first, true);
  }

  /// Nodes that are one and the same, over all pairs of boundaries: an edge may have four of them.
  using Class = std::vector<SharedNode>;
  struct TiedBlock {
    int block;
    std::vector<int> components;
    std::vector<Class> classes;
  };

  [[nodiscard]] std::vector<SharedNode> nodes_on(const ConstraintSetup& setup, int block,
                                                 const std::string& boundary) const {
    const Space& space = *field_->blocks()[block].space;
    std::vector<SharedNode> own;
    for (const int node : setup.boundary_nodes(*field_, block, boundary)) {
      if (node >= space.owned_nodes()) continue;
      SharedNode& shared = own.emplace_back(SharedNode{space.global_node(node), space.owner(node), {}});
      std::copy_n(space.position(node), field_->mesh().dimension(), shared.position);
    }
    return field_->mesh().communicator().gather_all(own);
  }

  [[nodiscard]] std::vector<Class> classes_of(const ConstraintSetup& setup, int block) const {
    std::map<int, int> number;  // of a global node
    std::vector<SharedNode> all;
    std::vector<std::pair<int, int>> pairs;
    const auto number_of = [&](const SharedNode& node) {
      const auto [found, is_new] = number.emplace(node.global, static_cast<int>(all.size()));
      if (is_new) all.push_back(node);
      return found->second;
    };
    for (std::size_t k = 0; k < boundaries_.size(); k += 2) {
      const std::vector<SharedNode> first = nodes_on(setup, block, boundaries_[k]),
                                    second = nodes_on(setup, block, boundaries_[k + 1]);
      for (const auto& [a, b] : match(first, second, k))
        pairs.emplace_back(number_of(first[a]), number_of(second[b]));
    }
    DisjointSets sets(static_cast<int>(all.size()));
    for (const auto& [a, b] : pairs) sets.unite(a, b);
    std::map<int, Class> classes;
    for (std::size_t n = 0; n < all.size(); ++n) classes[sets.root(static_cast<int>(n))].push_back(all[n]);
    std::vector<Class> result;
    for (auto& [root, nodes] : classes) {
      std::ranges::sort(nodes, {}, &SharedNode::global);
      result.push_back(std::move(nodes));
    }
    return result;
  }

  /// Pairs of nodes a translation apart, by their numbers in the lists.
  [[nodiscard]] std::vector<std::pair<int, int>> match(const std::vector<SharedNode>& first,
                                                       const std::vector<SharedNode>& second,
                                                       std::size_t pair) const {
    constexpr double tolerance = 1e-8;  // of the boundaries' extent
    const int dim = field_->mesh().dimension();
    const auto range = [](const std::vector<SharedNode>& nodes, int d) {
      double low = INFINITY, high = -INFINITY;
      for (const SharedNode& node : nodes) {
        low = std::min(low, node.position[d]);
        high = std::max(high, node.position[d]);
      }
      return std::pair(low, high);
    };
    double shift[3] = {}, extent = -1;
    int along = 0;  // the coordinate in which the boundary extends most: partners are near in it
    for (int d = 0; d < dim; ++d) {
      const auto [low, high] = range(first, d);
      shift[d] = range(second, d).first - low;
      if (high - low > extent) {
        extent = high - low;
        along = d;
      }
    }
    const auto distance = [&](const SharedNode& a, const SharedNode& b) {
      double most = 0;
      for (int d = 0; d < dim; ++d) most = std::max(most, std::abs(b.position[d] - a.position[d] - shift[d]));
      return most;
    };
    std::vector<int> order(second.size());
    for (std::size_t b = 0; b < order.size(); ++b) order[b] = static_cast<int>(b);
    std::ranges::sort(order, {}, [&](int b) { return second[b].position[along]; });
    std::vector<std::pair<int, int>> result;
    for (std::size_t a = 0; a < first.size(); ++a) {
      const double wanted = first[a].position[along] + shift[along];
      auto candidate = std::ranges::lower_bound(order, wanted - tolerance * extent, {},
                                                [&](int b) { return second[b].position[along]; });
      while (candidate != order.end() && second[*candidate].position[along] <= wanted + tolerance * extent &&
             distance(first[a], second[*candidate]) > tolerance * extent)
        ++candidate;
      if (candidate == order.end() || distance(first[a], second[*candidate]) > tolerance * extent)
        throw Error(
            where_,
            fmt::format("the node ({:.8g}) on '{}' of field '{}' has none on '{}' at the same place but for "
                        "({:.6g}): periodic boundaries need meshes that match",
                        fmt::join(first[a].position, first[a].position + dim, ", "), boundaries_[pair], name_,
                        boundaries_[pair + 1], fmt::join(shift, shift + dim, ", ")));
      result.emplace_back(static_cast<int>(a), *candidate);
    }
    if (first.size() != second.size())
      throw Error(where_,
                  fmt::format("'{}' of field '{}' has {} nodes, '{}' has {}: periodic boundaries need "
                              "meshes that match",
                              boundaries_[pair], name_, first.size(), boundaries_[pair + 1], second.size()));
    return result;
  }

  /// All of a class are tied to the first that is prescribed, or else to the first that is there: bodies may
  /// cover others.
  void tie_block(Ties& ties, const TiedBlock& of) const {
    const Block& block = field_->blocks()[of.block];
    const Space& space = *block.space;
    constexpr double absent = 0, free = 1, held = 2;
    std::vector<double> state;  // [class][node][component]
    for (const Class& nodes : of.classes)
      for (const SharedNode& shared : nodes) {
        const int node = space.local_node(shared.global);
        const bool own = node >= 0 && node < space.owned_nodes();
        for (const int c : of.components)
          state.push_back(!own || block.active[node] == 0 ? absent : is_free(block, node, c) ? free : held);
      }
    field_->mesh().communicator().sum(state);
    const double* at = state.data();
    for (const Class& nodes : of.classes) {
      for (std::size_t c = 0; c < of.components.size(); ++c) tie_class(ties, of, nodes, c, at);
      at += nodes.size() * of.components.size();
    }
  }

  void tie_class(Ties& ties, const TiedBlock& of, const Class& nodes, std::size_t c,
                 const double* state) const {
    const auto state_of = [&](std::size_t n) { return state[n * of.components.size() + c]; };
    std::size_t master = nodes.size();
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (state_of(n) > (master == nodes.size() ? 0 : state_of(master))) master = n;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (n != master && state_of(n) == 1)
        ties.tie(place(ties, of, nodes[n], c), {{place(ties, of, nodes[master], c), 1, 1}}, 0);
  }

  [[nodiscard]] UnknownPlace place(const Ties& ties, const TiedBlock& of, const SharedNode& node,
                                   std::size_t c) const {
    UnknownPlace result{ties.number_of(*field_, of.block), node.global, of.components[c], node.owner, {}};
    std::copy_n(node.position, 3, result.position);
    return result;
  }

  Location where_;
  std::string name_;
  std::vector<std::string> boundaries_, unknowns_;
  Field* field_ = nullptr;
  std::vector<TiedBlock> blocks_;
};

}  // namespace

void register_periodic(Registry& registry) {
  Schema schema("What leaves a field at a boundary enters it at the opposite one, a translation away.");
  schema.reference("field", "The field", "field");
  schema.names(
      "boundaries",
      "Pairs of boundaries whose nodes match, one pair after the other; those that share edges in one "
      "constraint");
  schema.names("unknowns", "Which unknowns continue; none: all").otherwise("[]");
  registry.add<Constraint>("constraint", "periodic", schema, [](const Parameters& p, const Registry&) {
    return std::make_unique<Periodic>(p);
  });
}

}  // namespace seam
