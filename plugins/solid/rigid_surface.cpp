// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_surface.hpp"

#include <array>

#include "quantities.hpp"
#include "rotation.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/constraint/constraint.hpp"
#include "seam/constraint/node_selection.hpp"
#include "seam/term/fad.hpp"
#include "seam/term/kernel_term.hpp"

namespace seam::solid {
namespace {

/// Where a rigid body is: what all ranks know of its unknowns.
struct Motion {
  UnknownPlace centre;  ///< its node; component 0
  std::array<double, 3> translation{}, rotation{};
};

/// u = x + (R(phi) - I) (X - X0): the displacement of each node of a field follows from the translation x and
/// the rotation phi of a rigid body with centre X0. Its forces, handed on with the derivatives, are the
/// body's force and the moments that do work on phi.
class Rigid final : public Constraint {
 public:
  explicit Rigid(const Parameters& p)
      : where_(p.where()), name_(p.text("field")), body_name_(p.text("body")) {}

  void build(ConstraintSetup& setup) override {
    surface_ = &setup.field(name_);
    body_ = &setup.field(body_name_);
    place_ = surface_->place("displacement");
    translation_ = body_->place("translation");
    rotation_ = body_->place("rotation");
  }

  void tie(Ties& ties, const TimePoint&) const override {
    const Motion motion = present(ties);
    const Block& block = surface_->blocks()[place_.block];
    for (int node = 0; node < block.space->owned_nodes(); ++node) tie_node(ties, motion, block, node);
  }

 private:
  using First = Fad<3, double>;
  using Second = Fad<3, First>;

  [[nodiscard]] Motion present(const Ties& ties) const {
    const Block& block = body_->blocks()[translation_.block];
    std::vector<Motion> own;
    for (int node = 0; node < block.space->owned_nodes(); ++node) {
      Motion& motion = own.emplace_back();
      motion.centre = ties.place(*body_, translation_.block, node, 0);
      const double* now = &block.now.value[static_cast<std::size_t>(node) * block.size];
      for (int c = 0; c < translation_.components; ++c) motion.translation[c] = now[translation_.offset + c];
      // In the plane the body turns about the third axis.
      for (int c = 0; c < rotation_.components; ++c)
        motion.rotation[first_axis() + c] = now[rotation_.offset + c];
    }
    own = body_->mesh().communicator().gather_all(own);
    return own.at(0);
  }
  [[nodiscard]] int first_axis() const { return rotation_.components == 1 ? 2 : 0; }

  void tie_node(Ties& ties, const Motion& motion, const Block& block, int node) const {
    const int dim = surface_->mesh().dimension();
    Vec<3, Second> phi, arm;
    for (int k = 0; k < 3; ++k) {
      phi[k] = Second(First(motion.rotation[k], k), k);
      if (k < dim) arm[k] = Second(block.space->position(node)[k] - motion.centre.position[k]);
    }
    const Vec<3, Second> turned = rotation_tensor(phi) * arm;
    for (int i = 0; i < dim; ++i) {
      if (!is_free(block, node, place_.offset + i)) continue;
      std::vector<TiedTo> to{{component(motion, translation_.offset + i), 1, 1}};
      double constant = turned[i].v.v - arm[i].v.v;
      for (int c = 0; c < rotation_.components; ++c) {
        const double slope = turned[i].d[first_axis() + c].v;
        to.push_back({component(motion, rotation_.offset + c), slope, slope});
        constant -= slope * motion.rotation[first_axis() + c];
      }
      ties.tie(ties.place(*surface_, place_.block, node, place_.offset + i), std::move(to), constant);
      for (int c = 0; c < rotation_.components; ++c)
        for (int k = 0; k < rotation_.components; ++k)
          ties.add_change(component(motion, rotation_.offset + c), component(motion, rotation_.offset + k),
                          turned[i].d[first_axis() + c].d[first_axis() + k]);
    }
  }
  static UnknownPlace component(const Motion& motion, int c) {
    UnknownPlace place = motion.centre;
    place.component = c;
    return place;
  }

  Location where_;
  std::string name_, body_name_;
  Field *surface_ = nullptr, *body_ = nullptr;
  Field::ComponentRange place_{}, translation_{}, rotation_{};
};

}  // namespace

Schema RigidSurface::schema() {
  Schema s("The points of a rigid body, for interfaces: a constraint `rigid` lets them follow it.");
  s.reference("mesh", "That of the rigid body", "mesh");
  s.integer("order", "Of the displacement between its nodes: that of the mesh")
      .otherwise("1")
      .at_least(1)
      .at_most(2);
  return s;
}

void RigidSurface::build(FieldSetup& setup) const {
  setup.add_output("velocity", make_quantity(Velocity{}), {"displacement"});
}

void declare_rigid(Registry& registry) {
  Schema schema("The points of a field move with a rigid body, and what acts on them acts on it.");
  schema.reference("field", "A field with a displacement, as a `rigid_surface`", "field");
  schema.reference("body", "The `rigid_body`", "field");
  registry.add<Constraint>("constraint", "rigid", schema,
                           [](const Parameters& p, const Registry&) { return std::make_unique<Rigid>(p); });
}

}  // namespace seam::solid
