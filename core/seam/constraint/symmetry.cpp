// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "seam/assembly/together.hpp"
#include "seam/constraint/constraint.hpp"
#include "seam/constraint/node_selection.hpp"
#include "seam/constraint/types.hpp"
#include "seam/plugin/registry.hpp"

namespace seam {
namespace {

using Direction = std::array<double, 3>;

/// Unit normal of a boundary. @throws Error where it is none of one plane
Direction normal_of(const Mesh& mesh, const std::string& boundary, const Location& where) {
  const MeshData& whole = mesh.whole();
  const int dim = whole.dimension;
  const CellTopology& cell = topology(whole.type);
  const auto vertex = [&](const CellFace& face, std::size_t v) {
    const int node = whole.cells[static_cast<std::size_t>(face.cell) * whole.nodes_per_cell() +
                                 cell.face_nodes[face.face][v]];
    return &whole.coordinates[static_cast<std::size_t>(node) * dim];
  };
  static_cast<void>(mesh.boundary(boundary));  // throws when there is none
  const std::vector<CellFace>& faces = whole.boundaries.at(boundary);
  Direction normal{};
  for (const CellFace& face : faces) {
    const double *a = vertex(face, 0), *b = vertex(face, 1);
    Direction area{b[1] - a[1], a[0] - b[0], 0};
    if (dim == 3) {
      const double* c = vertex(face, 2);
      for (int d = 0; d < 3; ++d) {
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        area[d] = (b[e] - a[e]) * (c[f] - a[f]) - (b[f] - a[f]) * (c[e] - a[e]);
      }
    }
    for (int d = 0; d < 3; ++d) normal[d] += area[d];
  }
  const double size = std::hypot(normal[0], normal[1], normal[2]);
  for (double& n : normal) n /= size;
  // Roundings of a normal's zeros would be ties of their own.
  for (double& n : normal)
    if (std::abs(n) < 1e-14) n = 0;
  const std::size_t per_face = static_cast<std::size_t>(topology(cell.face_type).nodes(whole.order));
  const double* origin = vertex(faces.front(), 0);
  double off = 0, extent = 0;
  for (const CellFace& face : faces)
    for (std::size_t v = 0; v < per_face; ++v) {
      double along = 0, square = 0;
      for (int d = 0; d < dim; ++d) {
        const double way = vertex(face, v)[d] - origin[d];
        along += normal[d] * way;
        square += way * way;
      }
      off = std::max(off, std::abs(along));
      extent = std::max(extent, std::sqrt(square));
    }
  if (!(off <= 1e-8 * extent))
    throw Error(where,
                fmt::format("boundary '{}' of mesh '{}' is not plane: nodes lie up to {:.3g} m off one plane",
                            boundary, mesh.name(), off));
  return normal;
}

/// A vector has no component normal to planes: points stay in them and are free to glide.
class Symmetry final : public Constraint {
 public:
  explicit Symmetry(const Parameters& p)
      : where_(p.where()),
        name_(p.text("field")),
        boundaries_(p.names("boundaries")),
        unknown_(p.has("unknown") ? p.text("unknown") : "") {}

  void build(ConstraintSetup& setup) override {
    field_ = &setup.field(name_);
    place_ = field_->place(unknown_.empty() ? only_vector() : unknown_);
    const int dim = field_->mesh().dimension();
    if (place_.components != dim)
      throw Error(where_, fmt::format("'{}' of field '{}' has {} components; a vector of {} was expected",
                                      unknown_, name_, place_.components, dim));
    for (const std::string& boundary : boundaries_) {
      setup.close(*field_, boundary);
      const Direction normal = normal_of(field_->mesh(), boundary, where_);
      for (const int node : setup.boundary_nodes(*field_, place_.block, boundary))
        normals_[node].push_back(normal);
    }
  }

  void tie(Ties& ties, const TimePoint&) const override {
    const Block& block = field_->blocks()[place_.block];
    together(field_->mesh().communicator(), [&] {
      for (const auto& [node, normals] : normals_)
        if (node < block.space->owned_nodes() && block.active[node] != 0)
          tie_node(ties, block, node, normals);
    });
  }

 private:
  /// The field's unknown that is a vector and moves something. @throws Error where several may be meant
  [[nodiscard]] std::string only_vector() const {
    std::vector<std::string> found;
    for (const Unknown& unknown : field_->unknowns())
      if (!unknown.given && !unknown.boundaries && unknown.components == field_->mesh().dimension())
        found.push_back(unknown.name);
    if (found.size() == 1) return found.front();
    throw Error(where_, fmt::format("field '{}' has {} vectors ({}): name one by `unknown`", name_,
                                    found.size(), fmt::join(found, ", ")));
  }

  /// Solves normal . u = 0, for all planes through a node, for as many components as there are planes, the
  /// ones with the largest coefficients: Gauss-Jordan elimination. What is prescribed stays on the right.
  void tie_node(Ties& ties, const Block& block, int node, std::vector<Direction> rows) const {
    constexpr double nothing = 1e-10;
    const int dim = field_->mesh().dimension();
    std::array<bool, 3> solved{};
    std::vector<int> pivot;
    for (std::size_t r = 0; r < rows.size();) {
      int best = -1;
      for (int c = 0; c < dim; ++c)
        if (!solved[c] && is_free(block, node, place_.offset + c) &&
            (best < 0 || std::abs(rows[r][c]) > std::abs(rows[r][best])))
          best = c;
      if (best < 0 || std::abs(rows[r][best]) < nothing) {  // it says what others say already
        rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(r));
        continue;
      }
      const double factor = rows[r][best];
      for (double& entry : rows[r]) entry /= factor;
      for (std::size_t other = 0; other < rows.size(); ++other) {
        const double part = rows[other][best];
        for (int c = 0; c < dim && other != r; ++c) rows[other][c] -= part * rows[r][c];
      }
      solved[best] = true;
      pivot.push_back(best);
      ++r;
    }
    const auto place = [&](int c) { return ties.place(*field_, place_.block, node, place_.offset + c); };
    for (std::size_t r = 0; r < rows.size(); ++r) {
      std::vector<TiedTo> to;
      for (int c = 0; c < dim; ++c)
        if (c != pivot[r] && std::abs(rows[r][c]) > 1e-15) to.push_back({place(c), -rows[r][c], -rows[r][c]});
      ties.tie(place(pivot[r]), std::move(to), 0);
    }
  }

  Location where_;
  std::string name_;
  std::vector<std::string> boundaries_;
  std::string unknown_;
  Field* field_ = nullptr;
  Field::ComponentRange place_{};
  std::map<int, std::vector<Direction>> normals_;  ///< of the planes through each local node
};

}  // namespace

void register_symmetry(Registry& registry) {
  Schema schema(
      "Planes, in any direction, in which a vector has no normal component: symmetry, or a smooth wall.");
  schema.reference("field", "The field", "field");
  schema.names("boundaries", "Plane boundaries; those that share edges in one constraint");
  schema.text("unknown", "Which vector, where the field has several").optional();
  registry.add<Constraint>("constraint", "symmetry", schema, [](const Parameters& p, const Registry&) {
    return std::make_unique<Symmetry>(p);
  });
}

}  // namespace seam
