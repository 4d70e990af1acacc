// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/constraint_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/scene/expression.hpp"

namespace seam {
namespace {

/// Around nodes of a mesh.
struct Box {
  std::array<double, 3> low, high;

  Box() {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
  }
  void include(const double* x, int dimension) {
    for (int d = 0; d < dimension; ++d) {
      low[d] = std::min(low[d], x[d]);
      high[d] = std::max(high[d], x[d]);
    }
  }
  [[nodiscard]] double size(int dimension) const {
    double largest = 0;
    for (int d = 0; d < dimension; ++d) largest = std::max(largest, high[d] - low[d]);
    return largest;
  }
};

Box box_of(const MeshData& mesh) {
  Box box;
  for (int n = 0; n < mesh.node_count(); ++n)
    box.include(&mesh.coordinates[static_cast<std::size_t>(n) * mesh.dimension], mesh.dimension);
  return box;
}

/// Where the corners of a face are.
std::vector<const double*> corners_of(const MeshData& mesh, const CellFace& face) {
  std::vector<const double*> corners;
  for (const int corner : topology(mesh.type).faces[face.face]) {
    const int node = mesh.cells[static_cast<std::size_t>(face.cell) * mesh.nodes_per_cell() + corner];
    corners.push_back(&mesh.coordinates[static_cast<std::size_t>(node) * mesh.dimension]);
  }
  return corners;
}

/// A mean of how long faces are. @param within those of which a corner lies in this box; 0 where none does
double mean_length(const MeshData& mesh, const std::vector<CellFace>& faces, const Box& within) {
  double sum = 0;
  int count = 0;
  const double slack = 1e-6 * within.size(mesh.dimension);
  for (const CellFace& face : faces) {
    double longest = 0;
    bool inside = false;
    for (const double* a : corners_of(mesh, face)) {
      bool is_in = true;
      for (int d = 0; d < mesh.dimension; ++d)
        is_in = is_in && a[d] > within.low[d] - slack && a[d] < within.high[d] + slack;
      inside = inside || is_in;
      for (const double* b : corners_of(mesh, face)) {
        double square = 0;
        for (int d = 0; d < mesh.dimension; ++d) square += (a[d] - b[d]) * (a[d] - b[d]);
        longest = std::max(longest, std::sqrt(square));
      }
    }
    if (!inside) continue;
    sum += longest;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

class ConstraintDoubts {
 public:
  explicit ConstraintDoubts(const SceneAtStart& scene) : at_(scene) {}

  std::vector<Diagnostic> find() {
    for (const auto& [name, field] : at_.scene.root.map("fields")) {
      if (field.type() == "rigid_body") look_at_body(name, field);
      if (field.type() == "rigid_surface") look_at_order(name, field);
    }
    for (const Parameters& constraint : at_.scene.root.list("constraints")) {
      if (constraint.type() == "rigid") look_at_rigid(constraint);
      if (constraint.type() == "joint") look_at_joint(constraint);
      if (constraint.type() == "tied") look_at_tied(constraint);
    }
    return std::move(found_);
  }

 private:
  void warn(Location where, std::string message) {
    found_.push_back({Diagnostic::Severity::warning, std::move(where), std::move(message)});
  }
  [[nodiscard]] const FieldEntry& entry(const std::string& name) const {
    return at_.built.problem->field(name);
  }
  [[nodiscard]] const Parameters& parameters(const std::string& field) const {
    const auto& fields = at_.scene.root.map("fields");
    return std::ranges::find(fields, field, &std::pair<std::string, Parameters>::first)->second;
  }

  /// Degrees are many radians.
  /// @param what gives the angle @param x where
  void look_at_angle(const Location& where, const std::string& what, const Expression& angle,
                     const double* x) {
    const int dim = at_.scene.root.dimension();
    const double first = angle(x, dim, at_.start), turned = angle(x, dim, at_.start + at_.step) - first;
    constexpr double turn = 2 * std::numbers::pi;
    const std::string mend = "angles are in radians; where degrees are meant, multiply them by pi/180";
    if (std::abs(first) > turn)
      warn(where, fmt::format("{} is {:.4g} rad at the start, more than a whole turn, by `{}`: {}", what,
                              first, angle.text(), mend));
    else if (std::abs(turned) > turn / 2)
      warn(where, fmt::format("{} changes by {:.4g} rad in the first step, of {:.4g} s, more than half a "
                              "turn, by `{}`: {}, else take shorter steps",
                              what, turned, at_.step, angle.text(), mend));
  }

  void look_at_joint(const Parameters& joint) {
    if (joint.text("kind") != "hinge" || !joint.has("motion")) return;
    double at[3] = {};
    if (joint.has("at")) std::ranges::copy(joint.vector("at"), at);
    look_at_angle(joint.where("motion"), fmt::format("the `motion` of the hinge of '{}'", joint.text("body")),
                  joint.expression("motion"), at);
  }

  void look_at_body(const std::string& name, const Parameters& body) {
    const double* centre = entry(name).mesh->whole().coordinates.data();
    if (body.has("rotation"))
      for (std::size_t d = 0; d < body.vector_expression("rotation").size(); ++d)
        if (body.component_given("rotation", static_cast<int>(d)))
          look_at_angle(body.where("rotation"), fmt::format("the `rotation` of '{}'", name),
                        body.vector_expression("rotation")[d], centre);
  }

  void look_at_order(const std::string& name, const Parameters& skin) {
    const int order = entry(name).mesh->order();
    if (skin.integer("order") <= order) return;
    warn(
        skin.where("order"),
        fmt::format("field '{}' is of order {} on a mesh of order {}, with straight edges: a rigid motion of "
                    "these needs no more than order {}; for a surface that is curved give the mesh `order: "
                    "{}`, too, else leave this out",
                    name, skin.integer("order"), order, order, skin.integer("order")));
  }

  void look_at_rigid(const Parameters& rigid) {
    if (rigid.has("on")) return;
    const std::string &name = rigid.text("field"), &body = rigid.text("body");
    for (const PrescribedCondition& condition : entry(name).conditions) {
      if (condition.unknown != "displacement") continue;
      warn(rigid.where(),
           fmt::format(
               "all of field '{}' is to follow '{}', but for what is given on boundary '{}' ({}): that "
               "stays, and the cells between are torn; leave what gives it out, or say `on`, the "
               "boundary that is to follow",
               name, body, condition.boundary, condition.where.text()));
      return;
    }
    if (parameters(name).type() != "rigid_surface" || parameters(body).type() != "rigid_body") return;
    const MeshData &skin = entry(name).mesh->whole(), &shape = entry(body).shape->whole();
    const Box around_skin = box_of(skin), around_body = box_of(shape);
    const double size = around_body.size(shape.dimension);
    for (int d = 0; d < shape.dimension; ++d) {
      constexpr double alike = 0.02;  // of two meshes of one shape
      if (std::abs(around_skin.low[d] - around_body.low[d]) <= alike * size &&
          std::abs(around_skin.high[d] - around_body.high[d]) <= alike * size)
        continue;
      const Location where = parameters(name).where("mesh");
      warn(where,
           fmt::format("the points of '{}' are those of mesh '{}', and '{}', which they follow, has the "
                       "shape of mesh '{}', which lies elsewhere or is of another size: what acts on the "
                       "points acts on a body with another mass and centre; take one mesh for both",
                       name, parameters(name).text("mesh"), body, parameters(body).text("mesh")));
      return;
    }
  }

  /// Between nodes of the tied side that are far apart nothing holds the nodes of the other one.
  void look_at_tied(const Parameters& tied) {
    const std::vector<std::string>&fields = tied.names("fields"), &boundaries = tied.names("boundaries");
    const MeshData *mesh[2], *const first = &entry(fields[0]).mesh->whole();
    Box around;
    for (const CellFace& face : first->boundaries.at(boundaries[0]))
      for (const double* corner : corners_of(*first, face)) around.include(corner, first->dimension);
    double apart[2];  // nodes
    for (int k = 0; k < 2; ++k) {
      mesh[k] = &entry(fields[k]).mesh->whole();
      apart[k] = mean_length(*mesh[k], mesh[k]->boundaries.at(boundaries[k]), around) /
                 entry(fields[k]).field->order();
    }
    constexpr double slack = 1.1;
    if (apart[1] == 0 || apart[0] < slack * apart[1]) return;
    warn(
        tied.where("fields"),
        fmt::format("the coarser side is tied: nodes on '{}' of field '{}' are {:.3g} m apart, those on '{}' "
                    "of field '{}', which they keep to, {:.3g} m: what lies between the tied nodes follows "
                    "nothing, and the fields part there; exchange the two, in `boundaries` as well",
                    boundaries[0], fields[0], apart[0], boundaries[1], fields[1], apart[1]));
  }

  const SceneAtStart& at_;
  std::vector<Diagnostic> found_;
};

}  // namespace

std::vector<Diagnostic> constraint_doubts(const SceneAtStart& scene) {
  return ConstraintDoubts(scene).find();
}

}  // namespace seam
