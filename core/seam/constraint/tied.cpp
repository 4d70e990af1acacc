// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "seam/assembly/domains.hpp"
#include "seam/assembly/remote_cells.hpp"
#include "seam/assembly/together.hpp"
#include "seam/constraint/constraint.hpp"
#include "seam/constraint/joins_fields.hpp"
#include "seam/constraint/node_selection.hpp"
#include "seam/constraint/types.hpp"
#include "seam/cut/cell_search.hpp"
#include "seam/plugin/registry.hpp"

namespace seam {
namespace {

/// How far a place lies from the plane or line of a face, in reference coordinates of its cell.
double distance_to_face(const CellTopology& cell, int face, const std::vector<double>& x) {
  const int dim = cell.dimension;
  const std::vector<int>& corners = cell.faces[face];
  const auto from_first = [&](const double* to) {
    std::array<double, 3> way{};
    for (int d = 0; d < dim; ++d) way[d] = to[d] - cell.node_coordinates[corners[0] * dim + d];
    return way;
  };
  const auto edge = [&](int k) { return from_first(&cell.node_coordinates[corners[k] * dim]); };
  const std::array<double, 3> a = edge(1), b = dim == 3 ? edge(2) : std::array<double, 3>{0, 0, 1};
  const double normal[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const std::array<double, 3> way = from_first(x.data());
  return std::abs(normal[0] * way[0] + normal[1] * way[1] + normal[2] * way[2]) /
         std::hypot(normal[0], normal[1], normal[2]);
}

/// How far off a face, in reference coordinates of its cell, what counts as on it may lie.
constexpr double beside = 1e-2;

double from_face(const PlaceInCell& place, CellType type, int face) {
  return std::max(place.outside, distance_to_face(topology(type), face, place.reference));
}

/// The middle of a face's corners.
std::vector<double> middle_of(const Mesh& mesh, const CellFace& face) {
  const int dim = mesh.dimension();
  const std::vector<int>& corners = topology(mesh.type()).faces[face.face];
  std::vector<double> middle(dim, 0.0);
  for (const int corner : corners)
    for (int d = 0; d < dim; ++d)
      middle[d] += mesh.geometry(face.cell)[corner * dim + d] / static_cast<double>(corners.size());
  return middle;
}

/// The cells at a boundary, found by the boxes that their faces lie in.
class FacesNearby {
 public:
  FacesNearby(const MeshData& whole, const std::vector<CellFace>& faces) : dim_(whole.dimension) {
    const CellTopology& cell = topology(whole.type);
    const std::size_t per_face = static_cast<std::size_t>(topology(cell.face_type).nodes(whole.order));
    std::vector<std::pair<cutting::Vector, cutting::Vector>> boxes;
    for (const CellFace& face : faces) {
      faces_.push_back(face);
      cutting::Vector low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
      if (dim_ == 2) low[2] = high[2] = 0;
      for (std::size_t a = 0; a < per_face; ++a) {
        const int local = cell.face_nodes[face.face][a];
        const int node = whole.cells[static_cast<std::size_t>(face.cell) * whole.nodes_per_cell() + local];
        for (int d = 0; d < dim_; ++d) {
          const double x = whole.coordinates[static_cast<std::size_t>(node) * dim_ + d];
          low[d] = std::min(low[d], x);
          high[d] = std::max(high[d], x);
        }
      }
      // Faces of curved surfaces that two meshes approximate in different ways lie beside each other.
      constexpr double apart = 0.1;
      const double margin = apart * std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
      for (int d = 0; d < dim_; ++d) {
        low[d] -= margin;
        high[d] += margin;
      }
      boxes.emplace_back(low, high);
    }
    search_ = std::make_unique<cutting::CellSearch>(boxes);
  }
  /// Appends the faces, of cells by global numbers, that may be at x.
  void find(const double* x, std::vector<CellFace>& faces) const {
    cutting::Vector at{};
    std::copy_n(x, dim_, at.begin());
    std::vector<int> found;
    search_->find(at, at, found);
    std::ranges::sort(found);
    for (const int face : found) faces.push_back(faces_[face]);
  }

 private:
  int dim_;
  std::vector<CellFace> faces_;
  std::unique_ptr<cutting::CellSearch> search_;
};

/// The nodes of one boundary follow the field on another one.
class Tied final : public Constraint, public JoinsFields {
 public:
  explicit Tied(const Parameters& p)
      : where_(p.where()),
        names_(p.names("fields")),
        boundaries_(p.names("boundaries")),
        unknowns_(p.names("unknowns")) {
    if (names_.size() != 2 || boundaries_.size() != 2)
      throw Error(
          where_,
          fmt::format(
              "found {} fields and {} boundaries, expected two of each: the one whose nodes are tied, "
              "and the one they are tied to",
              names_.size(), boundaries_.size()));
  }

  void build(ConstraintSetup& setup) override {
    tied_ = &setup.field(names_[0]);
    master_ = &setup.field(names_[1]);
    for (const Field* field : {tied_, master_})
      if (field->sets() > 1)
        throw Error(
            where_,
            fmt::format("field '{}' keeps parts of its cells apart (`parts: separate`): which of them "
                        "what is tied goes with is not known; take it without",
                        field->name()));
    if (unknowns_.empty())
      for (const Unknown& unknown : tied_->unknowns())
        if (!unknown.given && !unknown.boundaries) unknowns_.push_back(unknown.name);
    static_cast<void>(master_->mesh().boundary(boundaries_[1]));  // throws when there is none
    const FacesNearby faces(master_->mesh().whole(), master_->mesh().whole().boundaries.at(boundaries_[1]));
    for (const std::string& unknown : unknowns_) {
      const Field::ComponentRange from = tied_->place(unknown), to = master_->place(unknown);
      if (from.components != to.components)
        throw Error(where_, fmt::format("'{}' has {} components in field '{}' and {} in '{}'", unknown,
                                        from.components, names_[0], to.components, names_[1]));
      // Unknowns of one order have the same nodes.
      const auto known = std::ranges::find_if(
          pairs_, [&](const Pair& pair) { return pair.from == from.block && pair.to == to.block; });
      Pair& pair = known != pairs_.end()
                       ? *known
                       : pairs_.emplace_back(find_places(setup, faces, from.block, to.block));
      for (int c = 0; c < from.components; ++c) pair.components.emplace_back(from.offset + c, to.offset + c);
      if (from.components == 1) join(from, to, pair);
    }
  }

  [[nodiscard]] const std::vector<JoinedFields>& joined() const override { return joined_; }

  void tie(Ties& ties, const TimePoint&) const override {
    for (const Pair& pair : pairs_) {
      const Block& block = tied_->blocks()[pair.from];
      for (const Place& place : pair.places)
        for (const auto& [from, to] : pair.components) {
          if (!is_free(block, place.node, from)) continue;
          std::vector<TiedTo> masters;
          for (const auto& [node, share] : place.shares)
            masters.push_back({ties.place(*master_, pair.to, node, to), share, share});
          ties.tie(ties.place(*tied_, pair.from, place.node, from), std::move(masters), 0);
        }
    }
  }

 private:
  /// A tied node, and the nodes of the face it lies on with the values of their shape functions.
  struct Place {
    int node;
    std::vector<std::pair<int, double>> shares;
  };
  struct Pair {
    int from, to;  ///< blocks
    std::vector<std::pair<int, int>> components;
    std::vector<Place> places;
  };

  /// A number of one field goes on in the other one.
  void join(const Field::ComponentRange& from, const Field::ComponentRange& to, const Pair& pair) {
    JoinedFields& joined = joined_.emplace_back(
        JoinedFields{{tied_, from.block, from.offset, {}}, {master_, to.block, to.offset, {}}, {}});
    for (const Place& place : pair.places)
      for (const auto& [node, share] : place.shares) joined.nodes.emplace_back(place.node, node);
    const auto own_faces = [](const Field& field, const std::string& boundary) {
      std::vector<CellFace> faces = field.mesh().boundary(boundary);
      std::erase_if(faces, [&](const CellFace& face) { return face.cell >= field.mesh().owned_cells(); });
      return faces;
    };
    joined.tied.faces = own_faces(*tied_, boundaries_[0]);
    // The other boundary may be the larger one, and open beside what lies on it.
    const MeshData& whole = tied_->mesh().whole();
    const FacesNearby tied_faces(whole, whole.boundaries.at(boundaries_[0]));
    joined.other.faces = own_faces(*master_, boundaries_[1]);
    std::erase_if(joined.other.faces, [&](const CellFace& face) {
      return !lies_on(whole, tied_faces, middle_of(master_->mesh(), face).data());
    });
  }

  /// Whether a place lies on one of the tied faces, whose cells other ranks may own.
  [[nodiscard]] bool lies_on(const MeshData& whole, const FacesNearby& faces, const double* x) const {
    std::vector<CellFace> near;
    faces.find(x, near);
    return std::ranges::any_of(near, [&](const CellFace& face) {
      RemoteCell cell{face.cell, 0, {}, {}};
      for (int a = 0; a < whole.nodes_per_cell(); ++a) {
        const int node = whole.cells[static_cast<std::size_t>(face.cell) * whole.nodes_per_cell() + a];
        const double* at = &whole.coordinates[static_cast<std::size_t>(node) * whole.dimension];
        cell.geometry.insert(cell.geometry.end(), at, at + whole.dimension);
      }
      ElementSide side;
      cell.attach(side, *tied_);
      const auto in_cell = locate(side, x);
      return in_cell && from_face(*in_cell, whole.type, face.face) < beside;
    });
  }

  [[nodiscard]] Pair find_places(const ConstraintSetup& setup, const FacesNearby& faces, int from,
                                 int to) const {
    Pair pair{from, to, {}, {}};
    const Space& space = *tied_->blocks()[from].space;
    std::vector<int> nodes, cells;
    std::vector<CellFace> near;
    std::vector<std::size_t> end;  // of each node's candidates
    for (const int node : setup.boundary_nodes(*tied_, from, boundaries_[0])) {
      if (node >= space.owned_nodes()) continue;
      nodes.push_back(node);
      faces.find(space.position(node), near);
      end.push_back(near.size());
    }
    for (const CellFace& face : near) cells.push_back(face.cell);
    const std::vector<RemoteCell> candidates = fetch_cells(*master_, cells);
    together(master_->mesh().communicator(), [&] {
      std::size_t k = 0;
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        Place& place = pair.places.emplace_back(Place{nodes[n], {}});
        double least = beside;
        for (; k < end[n]; ++k)
          look_at(candidates[k], near[k].face, space.position(nodes[n]), to, least, place);
        if (place.shares.empty()) throw nothing_there(space.position(nodes[n]));
      }
    });
    return pair;
  }

  /// @param least how far the place lies from the best face so far, in reference coordinates of its cell
  void look_at(const RemoteCell& cell, int face, const double* x, int block, double& least,
               Place& place) const {
    ElementSide side;
    cell.attach(side, *master_);
    const auto in_cell = locate(side, x);
    if (!in_cell) return;
    const double away = std::max(
        in_cell->outside, distance_to_face(topology(master_->mesh().type()), face, in_cell->reference));
    if (!(away < least)) return;
    least = away;
    ShapeTable table;
    tabulate(master_->mesh().type(), master_->blocks()[block].space->order(), in_cell->reference.data(), 1,
             false, table);
    place.shares.clear();
    for (int a = 0; a < table.nodes; ++a)
      if (std::abs(table.value[a]) > 1e-10) place.shares.emplace_back(cell.nodes[block][a], table.value[a]);
  }

  [[nodiscard]] Error nothing_there(const double* x) const {
    return {where_,
            fmt::format("the node ({:.8g}) on '{}' of field '{}' lies on no face of '{}' of field '{}': the "
                        "tied boundary must lie on the other one",
                        fmt::join(x, x + tied_->mesh().dimension(), ", "), boundaries_[0], names_[0],
                        boundaries_[1], names_[1])};
  }

  Location where_;
  std::vector<std::string> names_, boundaries_, unknowns_;
  Field *tied_ = nullptr, *master_ = nullptr;
  std::vector<Pair> pairs_;
  std::vector<JoinedFields> joined_;
};

}  // namespace

void register_tied(Registry& registry) {
  Schema schema(
      "The nodes of a boundary keep to the field on another one, whose mesh need not match: bonded or fitted "
      "patches.");
  schema.names("fields", "The field whose nodes are tied, better the finer one, and the one they are tied to")
      .naming("field");
  schema.names("boundaries",
               "A boundary of the first field's mesh that lies on one of the second's, and that one");
  schema.names("unknowns", "Which unknowns are tied; none: all of the first field").otherwise("[]");
  registry.add<Constraint>("constraint", "tied", schema,
                           [](const Parameters& p, const Registry&) { return std::make_unique<Tied>(p); });
}

}  // namespace seam
