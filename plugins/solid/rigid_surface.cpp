// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_surface.hpp"

#include "carried.hpp"
#include "quantities.hpp"
#include "rigid_motion.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/constraint/constraint.hpp"
#include "seam/constraint/node_selection.hpp"
#include "seam/term/fad.hpp"
#include "seam/term/kernel_term.hpp"

namespace seam::solid {
namespace {

/// u = x + (R - I) (X - X0): the displacement of each node of a field, or of one of its boundaries, follows
/// from the translation x and the rotation R of a rigid body with centre X0. Its forces act on the body with
/// the moments that they have about the body's axes.
class Rigid final : public Constraint, public Carried {
 public:
  explicit Rigid(const Parameters& p)
      : where_(p.has("on") ? p.where("on") : p.where()),
        name_(p.text("field")),
        body_name_(p.text("body")),
        boundary_(p.has("on") ? p.text("on") : "") {}

  void build(ConstraintSetup& setup) override {
    surface_ = &setup.field(name_);
    place_ = surface_->place("displacement");
    body_ = RigidUnknowns(setup.field(body_name_));
    if (!boundary_.empty()) nodes_ = setup.boundary_nodes(*surface_, place_.block, boundary_);
  }

  void tie(Ties& ties, const TimePoint&) const override {
    const RigidPosition at = body_.present(ties);
    at_ = at;
    const int owned = surface_->blocks()[place_.block].space->owned_nodes();
    bool any = false;
    if (boundary_.empty())
      for (int node = 0; node < owned; ++node) any |= tie_node(ties, at, node);
    for (const int node : nodes_)
      if (node < owned) any |= tie_node(ties, at, node);
    if (surface_->mesh().communicator().any(any)) return;
    const std::string on = boundary_.empty() ? "" : " on boundary '" + boundary_ + "'";
    throw Error(where_, "all of the displacement" + on + " of field '" + name_ +
                            "' is given, so that nothing there can follow '" + body_name_ +
                            "'; leave what gives it out, or this constraint");
  }

  [[nodiscard]] const Field* carrier() const override { return &body_.field(); }

  [[nodiscard]] Forces handed_on(const HoldsField::Left& left,
                                 const std::vector<const Constraint*>&) const override {
    std::vector<double> sum(6, 0.0);
    const int owned = surface_->blocks()[place_.block].space->owned_nodes();
    if (boundary_.empty())
      for (int node = 0; node < owned; ++node) add_handed_on(left, node, sum);
    for (const int node : nodes_)
      if (node < owned) add_handed_on(left, node, sum);
    surface_->mesh().communicator().sum(sum);
    Forces forces{};
    std::ranges::copy(sum, forces.begin());
    return forces;
  }

 private:
  using First = Fad<3, double>;

  void add_handed_on(const HoldsField::Left& left, int node, std::vector<double>& sum) const {
    const Block& block = surface_->blocks()[place_.block];
    const int dim = surface_->mesh().dimension();
    Vec<3, double> arm, force, rotation{at_.rotation};
    for (int i = 0; i < dim; ++i) {
      arm[i] = block.space->position(node)[i] - at_.centre.position[i];
      if (is_free(block, node, place_.offset + i))
        force[i] = left(*surface_, place_.block, node, place_.offset + i);
      sum[i] += force[i];
    }
    // About the body's axes.
    const Vec<3, double> moment = skew(arm) * (transpose(at_.turn(rotation)) * force);
    for (int k = body_.first_axis(); k < 3; ++k) sum[3 + k] += moment[k];
  }

  /// @return whether any of its components follow
  bool tie_node(Ties& ties, const RigidPosition& at, int node) const {
    const Block& block = surface_->blocks()[place_.block];
    const int dim = surface_->mesh().dimension();
    Vec<3, First> rotation;
    Vec<3, double> arm, at_present;
    for (int k = 0; k < 3; ++k) {
      rotation[k] = First(at.rotation[k], k);
      at_present[k] = at.rotation[k];
      if (k < dim) arm[k] = block.space->position(node)[k] - at.centre.position[k];
    }
    const Mat<3, 3, First> turn = at.turn(rotation);
    const Vec<3, First> there = turn * arm;
    // How it moves with turns about each of the body's axes.
    const Mat<3, 3, First> lever = -1.0 * (turn * skew(arm));
    bool any = false;
    // And how that changes where the body turns on about them.
    std::array<Mat<3, 3, double>, 3> lever_turned;
    for (int l = 0; l < 3; ++l) {
      Vec<3, double> axis;
      axis[l] = 1;
      lever_turned[l] = -1.0 * (at.turn(at_present) * (skew(axis) * skew(arm)));
    }
    for (int i = 0; i < dim; ++i) {
      if (!is_free(block, node, place_.offset + i)) continue;
      any = true;
      std::vector<TiedTo> to{{body_.place(at, i), 1, 1}};
      double constant = there[i].v - arm[i];
      for (int k = body_.first_axis(); k < 3; ++k) {
        to.push_back({body_.place(at, 3 + k), there[i].d[k], lever(i, k).v});
        constant -= there[i].d[k] * at.rotation[k];
      }
      ties.tie(ties.place(*surface_, place_.block, node, place_.offset + i), std::move(to), constant);
      for (int k = body_.first_axis(); k < 3; ++k)
        for (int l = body_.first_axis(); l < 3; ++l)
          ties.add_change(body_.place(at, 3 + k), body_.place(at, 3 + l), lever(i, k).d[l],
                          lever_turned[l](i, k));
    }
    return any;
  }

  Location where_;
  std::string name_, body_name_, boundary_;
  Field* surface_ = nullptr;
  Field::ComponentRange place_{};
  std::vector<int> nodes_;  ///< of the boundary
  RigidUnknowns body_;
  mutable RigidPosition at_;  ///< where the body was when points were tied last
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
  setup.publish("rigid", 1);  // it has no stress
  setup.add_output("velocity", make_quantity(Velocity{}), {"displacement"});
}

void declare_rigid(Registry& registry) {
  Schema schema(
      "The points of a field, or of one of its boundaries, move with a rigid body, and what acts on "
      "them acts on it.");
  schema.reference("field", "A field with a displacement: a `rigid_surface`, or a body that deforms",
                   "field");
  schema.text("on", "Only the points of this boundary, as of a deformable body that is fixed to a rigid one")
      .optional();
  schema.reference("body", "The `rigid_body`", "field");
  registry.add<Constraint>("constraint", "rigid", schema,
                           [](const Parameters& p, const Registry&) { return std::make_unique<Rigid>(p); });
}

}  // namespace seam::solid
