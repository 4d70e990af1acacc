// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rotation.hpp"
#include "seam/field/field.hpp"
#include "seam/physics/body_terms.hpp"
#include "seam/physics/conditions.hpp"
#include "seam/scene/expression.hpp"
#include "seam/scene/function.hpp"
#include "seam/term/kernel_term.hpp"

namespace seam::solid {
namespace {

/// m d2x/dt2
struct RigidMass {
  using translation = Vector<0>;
  using Reads = Slots<SecondRate<translation>>;
  using Tests = Slots<Value<translation>>;
  double mass;  ///< kg
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(translation{}) += mass * s.second_rate(translation{});
  }
};

/// I d2(angle)/dt2, in the plane.
struct PlaneInertia {
  using rotation = Rotation<0>;
  using Reads = Slots<SecondRate<rotation>>;
  using Tests = Slots<Value<rotation>>;
  double inertia;  ///< about the centre, kg m^2
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    if constexpr (dim == 2) r.value(rotation{}) += inertia * s.second_rate(rotation{});
  }
};

/// In space: the angular momentum is p = R J W, with the angular velocity W in the body's axes, and its rate
/// the moment on the body, whose parts along these axes are the rotation's equations. With theta = 1/2 p and
/// the energy of a free body are kept whatever the step (Simo and Wong, Int. J. Numer. Methods Eng. 31, 1991:
/// the turn of a step is its length times the mean of W at both ends).
struct SpaceInertia {
  using rotation = Rotation<0>;
  using momentum = Rotation<1>;
  using orientation = OrientationOf<2>;
  using Reads = Slots<Value<rotation>, OldValue<rotation>, Rate<rotation>, SecondRate<rotation>,
                      Value<momentum>, Rate<momentum>, OldValue<orientation>>;
  using Tests = Slots<Value<rotation>, Value<momentum>>;
  Mat<3, 3, double> inertia;  ///< about the centre, in the reference position, kg m^2
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    if constexpr (dim == 3) {
      const Mat<3, 3, T> turn = rotation_tensor(orientation_of(s, rotation{}, orientation{}));
      const Vec<3, T> omega = s.rate(rotation{}), spin = inertia * omega;
      Vec<3, T> relation = s.value(momentum{}) - turn * spin;
      r.value(momentum{}) += relation;
      // Part of the relation, which is met, lets the rotation's equations contain the rotation itself. Where
      // the rates of what is known are asked for, at the start, it is the rate of the relation.
      double part = 1;
      if (x.step > 0) {
        part = 1 / (x.theta * x.step);
      } else {
        relation = s.rate(momentum{}) - turn * (inertia * s.second_rate(rotation{}) + skew(omega) * spin);
        r.value(momentum{}) += relation;
      }
      r.value(rotation{}) += transpose(turn) * (s.rate(momentum{}) - part * relation);
    }
  }
};

/// The orientation at the end of the step, for the next one.
struct SpaceOrientation {
  using rotation = Rotation<0>;
  using orientation = OrientationOf<1>;
  using Reads = Slots<Value<rotation>, OldValue<rotation>, Value<orientation>, OldValue<orientation>>;
  using Tests = Slots<Value<orientation>>;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    if constexpr (dim == 3)
      r.value(orientation{}) += s.value(orientation{}) - orientation_of(s, rotation{}, orientation{});
  }
};

/// Springs and dashpots to the reference position, and a load.
struct RigidForces {
  using translation = Vector<0>;
  using Reads = Slots<Value<translation>, Rate<translation>>;
  using Tests = Slots<Value<translation>>;
  std::vector<double> stiffness, damping;  ///< per component, N/m, N s/m
  std::vector<Expression> force;           ///< N; empty for none
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Vec<dim, T> d = s.value(translation{}), v = s.rate(translation{});
    Vec<dim, T> sum;
    for (int i = 0; i < dim; ++i) {
      sum[i] = stiffness[i] * d[i] + damping[i] * v[i];
      if (!force.empty()) sum[i] -= force[i](x.position.c.data(), dim, x.time);
    }
    r.value(translation{}) += sum;
  }
};

/// What springs, dashpots and loads there are against rotation.
struct Moment {
  double stiffness, damping;     ///< N m, N m s
  std::vector<Expression> load;  ///< N m; empty for none
  std::string where;             ///< of the spring, in the scene
};

struct PlaneMoments {
  using rotation = Rotation<0>;
  using Reads = Slots<Value<rotation>, Rate<rotation>>;
  using Tests = Slots<Value<rotation>>;
  Moment moment;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    if constexpr (dim == 2) {
      T turn = moment.stiffness * s.value(rotation{}) + moment.damping * s.rate(rotation{});
      if (!moment.load.empty()) turn -= moment.load[0](x.position.c.data(), dim, x.time);
      r.value(rotation{}) += turn;
    }
  }
};

struct SpaceMoments {
  using rotation = Rotation<0>;
  using orientation = OrientationOf<1>;
  using Reads = Slots<Value<rotation>, OldValue<rotation>, Rate<rotation>, OldValue<orientation>>;
  using Tests = Slots<Value<rotation>>;
  Moment moment;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    if constexpr (dim == 3) {
      const Quaternion<T> q = orientation_of(s, rotation{}, orientation{});
      Vec<3, T> turn = moment.damping * s.rate(rotation{});
      // The rotation vector is the same in the body's axes and in those of space.
      if (moment.stiffness > 0) {
        const Vec<3, T> angles = counted_rotation_vector(q);
        require_within_a_turn(counted_rotation_vector(s.old_value(orientation{})), angles,
                              "the spring of `rotational_stiffness` at " + moment.where);
        turn += moment.stiffness * angles;
      }
      if (!moment.load.empty()) {
        Vec<3, double> load;
        for (int i = 0; i < 3; ++i) load[i] = moment.load[i](x.position.c.data(), dim, x.time);
        turn -= transpose(rotation_tensor(q)) * load;
      }
      r.value(rotation{}) += turn;
    }
  }
};

/// 1/2 m |v|^2 + 1/2 W . I W, J.
struct RigidKineticEnergy {
  using translation = Vector<0>;
  using rotation = Rotation<1>;
  using Reads = Slots<Rate<translation>, Rate<rotation>>;
  static constexpr int values(int) { return 1; }
  double mass;
  Mat<3, 3, double> inertia;
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    *value = 0.5 * mass * dot(s.rate(translation{}), s.rate(translation{}));
    if constexpr (dim == 2)
      *value += 0.5 * inertia(2, 2) * s.rate(rotation{}) * s.rate(rotation{});
    else
      *value += 0.5 * dot(s.rate(rotation{}), inertia * s.rate(rotation{}));
  }
};

/// What follows in space from how a body is turned at the start: the angles there are one rotation vector,
/// since there is no order of turns that could have led to them.
class SpaceStart final : public Function {
 public:
  /// @param angles given about the body's axes, 0 where they are free
  explicit SpaceStart(std::vector<Expression> angles) : angles_(std::move(angles)) {}
  [[nodiscard]] const std::vector<Member>& members() const override { return members_; }
  void evaluate(int, const double* x, double t, double* value) const override {
    Vec<3, double> turn;
    for (int k = 0; k < 3; ++k) turn[k] = angles_[k](x, 3, t);
    std::ranges::copy(turned(no_rotation, turn).c, value);
  }

 private:
  std::vector<Member> members_{{"orientation", 4}};
  std::vector<Expression> angles_;
};

/// Of the centre, m/s.
struct RigidVelocity {
  using translation = Vector<0>;
  using Reads = Slots<Rate<translation>>;
  static constexpr int values(int dim) { return dim; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    std::ranges::copy(s.rate(translation{}).c, value);
  }
};

/// Angular velocity, rad/s.
struct PlaneSpin {
  using rotation = Rotation<0>;
  using Reads = Slots<Rate<rotation>>;
  static constexpr int values(int) { return 1; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    if constexpr (dim == 2) *value = s.rate(rotation{});
  }
};

/// Angular velocity in axes of space, rad/s: the rotation's rates are about the body's own.
struct SpaceSpin {
  using rotation = Rotation<0>;
  using orientation = OrientationOf<1>;
  using Reads = Slots<Value<rotation>, OldValue<rotation>, Rate<rotation>, OldValue<orientation>>;
  static constexpr int values(int) { return 3; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    if constexpr (dim == 3)
      std::ranges::copy(
          (rotation_tensor(orientation_of(s, rotation{}, orientation{})) * s.rate(rotation{})).c, value);
  }
};

Mat<3, 3, double> inertia_of(const Moments& moments, double density, int dim) {
  Mat<3, 3, double> inertia;
  const auto& m = moments.second;
  const double trace = m[0][0] + m[1][1] + (dim == 3 ? m[2][2] : 0.0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inertia(i, j) = density * ((i == j ? trace : 0.0) - m[i][j]);
  return inertia;
}

/// @param length of the body, m
/// @throws Error where a force per mass varies within it, at some time: at the centre alone it would have
/// neither all of its sum nor its moment
void require_uniform(const std::vector<Expression>& force, const Moments& body, double length, int dim,
                     const Location& where) {
  const double arms[][3] = {{1, 0.7, 0.4}, {-0.8, 0.5, -0.9}};
  for (const Expression& component : force)
    for (const double time : {0.0, 1e-6, 1e-3, 1.0, 1e3, 1e6})
      for (const auto& arm : arms) {
        double beside[3];
        for (int d = 0; d < dim; ++d) beside[d] = body.centre[d] + length * arm[d];
        const double here = component(body.centre, dim, time), there = component(beside, dim, time);
        constexpr double rounding = 1e-12;
        // What is no number is told when it is used.
        if (!std::isfinite(here) || std::abs(there - here) <= rounding * std::abs(here)) continue;
        throw Error(
            where, fmt::format("the `body_force` of a rigid body is one force per mass for all of it, as "
                               "gravity is, and `{}` varies in space; give what it adds up to over the body, "
                               "as `force` and `moment`",
                               component.text()));
      }
}

/// About which a body turns.
int axes(int dimension) { return dimension == 2 ? 1 : 3; }

/// @throws Error where a list of the scene has another number of entries
void require_entries(const Parameters& of, const std::string& key, std::size_t found, int expected) {
  if (found != static_cast<std::size_t>(expected))
    throw Error(of.where(key), "`" + key + "` needs " + std::to_string(expected) + " entries, found " +
                                   std::to_string(found));
}

}  // namespace

Schema RigidBody::schema() {
  Schema s(
      "Body that moves without deforming; each component of its motion is given or follows from the forces.");
  s.reference("mesh", "Its shape, in the reference position", "mesh");
  s.vector_expression("translation", "Motion of its centre; null leaves a component free, default all free")
      .unit("m")
      .optional();
  s.vector_expression(
       "rotation",
       "Angle about its centre; in space three, about the body's own axes, of which rates add up "
       "to the angular velocity, at the start a rotation vector; null leaves one free")
      .unit("rad")
      .entries(-1)
      .optional();
  s.number("density", "Mass per volume; 0 for a body without inertia")
      .unit("kg/m^3")
      .otherwise("0")
      .at_least(0);
  s.vector("stiffness", "Springs that hold the centre, per direction").unit("N/m").at_least(0).optional();
  s.vector("damping", "Dashpots at the centre, per direction").unit("N s/m").at_least(0).optional();
  s.number("rotational_stiffness", "Spring against rotation: moment per angle; in space up to a turn")
      .unit("N m")
      .otherwise("0")
      .at_least(0);
  s.number("rotational_damping", "Dashpot against rotation").unit("N m s").otherwise("0").at_least(0);
  s.vector_expression("force", "Load at the centre").unit("N").optional();
  s.vector_expression("moment", "Load: one entry in 2D, three in 3D").unit("N m").entries(-1).optional();
  s.vector_expression("body_force", "Force per mass, the same in all of the body, as gravity")
      .unit("m/s^2")
      .optional();
  Schema initial("Motion at the start");
  initial.vector("velocity", "Velocity of the centre").unit("m/s").optional();
  initial.vector("rotation_rate", "Angular velocity: one entry in 2D, three in 3D, about the body's axes")
      .unit("rad/s")
      .entries(-1)
      .optional();
  s.object("initial", "Motion at the start; default at rest", initial).optional();
  return s;
}

int RigidBody::time_order() const {
  if (parameters_.number("density") > 0) return 2;
  return parameters_.has("damping") || parameters_.number("rotational_damping") > 0 ? 1 : 0;
}

std::vector<Unknown> RigidBody::unknowns(int dimension) const {
  const int order = time_order();
  const Unknown translation{"translation", dimension, 1, order, "m", UnknownRole::motion};
  Unknown rotation{"rotation", dimension == 2 ? 1 : 3, 1, order, "rad"};
  rotation.scale = 1;
  if (dimension == 2) return {translation, rotation};
  Unknown orientation{"orientation", 4, 1, 0, "", UnknownRole::derived};
  orientation.scale = 1;
  if (order < 2) return {translation, rotation, orientation};
  return {translation, rotation, orientation, {"angular_momentum", 3, 1, 1, "kg m^2/s"}};
}

void RigidBody::prescribe(FieldSetup& setup, const std::string& unknown) const {
  if (!parameters_.has(unknown)) return;
  require_entries(parameters_, unknown, parameters_.vector_expression(unknown).size(),
                  unknown == "translation" ? setup.dimension() : axes(setup.dimension()));
  prescribe_given(setup, parameters_, "", unknown);
}

void RigidBody::build(FieldSetup& setup) const {
  const int dim = setup.dimension();
  prescribe(setup, "translation");
  prescribe(setup, "rotation");
  const std::vector<double> none(dim, 0.0);
  setup.add_cell_term(
      make_term(RigidForces{
          parameters_.has("stiffness") ? parameters_.vector("stiffness") : none,
          parameters_.has("damping") ? parameters_.vector("damping") : none,
          parameters_.has("force") ? parameters_.vector_expression("force") : std::vector<Expression>{}}),
      {"translation"});
  const Moment moment{
      parameters_.number("rotational_stiffness"), parameters_.number("rotational_damping"),
      parameters_.has("moment") ? parameters_.vector_expression("moment") : std::vector<Expression>{},
      parameters_.where("rotational_stiffness").text()};
  if (parameters_.has("moment")) require_entries(parameters_, "moment", moment.load.size(), axes(dim));
  if (dim == 2) {
    setup.add_cell_term(make_term(PlaneMoments{moment}), {"rotation"});
  } else {
    setup.add_cell_term(make_term(SpaceMoments{moment}), {"rotation", "orientation"});
    setup.add_cell_term(make_term(SpaceOrientation{}), {"rotation", "orientation"});
  }

  const Moments moments = setup.moments();
  const auto& second = moments.second;
  const double length = std::sqrt((second[0][0] + second[1][1] + second[2][2]) / moments.volume);
  setup.publish("radius_of_gyration", length);
  // Without density and dashpots a body has these where it is given or tied to what moves.
  setup.add_output("velocity", make_quantity(RigidVelocity{}), {"translation"});
  if (dim == 2)
    setup.add_output("spin", make_quantity(PlaneSpin{}), {"rotation"});
  else
    setup.add_output("spin", make_quantity(SpaceSpin{}), {"rotation", "orientation"});
  const double density = parameters_.number("density");
  Mat<3, 3, double> inertia;
  if (density > 0) {
    const double mass = density * moments.volume;
    inertia_ = inertia = inertia_of(moments, density, dim);
    setup.add_cell_term(make_term(RigidMass{mass}), {"translation"});
    if (dim == 2)
      setup.add_cell_term(make_term(PlaneInertia{inertia(2, 2)}), {"rotation"});
    else
      setup.add_cell_term(make_term(SpaceInertia{inertia}), {"rotation", "angular_momentum", "orientation"});
    setup.add_integral("kinetic_energy", make_quantity(RigidKineticEnergy{mass, inertia}),
                       {"translation", "rotation"});
    if (parameters_.has("body_force")) {
      require_uniform(parameters_.vector_expression("body_force"), moments, length, dim,
                      parameters_.where("body_force"));
      setup.add_cell_term(make_term(BodyLoad{parameters_.vector_expression("body_force"), mass}),
                          {"translation"});
    }
  }
  if (parameters_.has("initial")) {
    const Parameters& initial = parameters_.object("initial");
    if (initial.has("rotation_rate"))
      require_entries(initial, "rotation_rate", initial.vector("rotation_rate").size(), axes(dim));
    for (const auto& [key, unknown] :
         {std::pair("velocity", "translation"), std::pair("rotation_rate", "rotation")})
      if (initial.has(key))
        for (std::size_t d = 0; d < initial.vector(key).size(); ++d)
          setup.set_initial_rate(unknown, static_cast<int>(d), Expression(initial.vector(key)[d]));
  }
  if (dim == 3) start_in_space(setup);
}

void RigidBody::start_in_space(FieldSetup& setup) const {
  std::vector<Expression> angles(3);
  for (int d = 0; d < 3; ++d) {
    if (!parameters_.has("rotation") || !parameters_.component_given("rotation", d)) continue;
    angles[d] = parameters_.vector_expression("rotation")[d];
    // The orientation is counted from there on, where a static problem does not impose it at the start, too.
    setup.set_initial("rotation", d, angles[d]);
  }
  const std::vector<Expression> orientation =
      Expression::components(std::make_shared<SpaceStart>(std::move(angles)), 0);
  for (std::size_t k = 0; k < orientation.size(); ++k)
    setup.set_initial("orientation", static_cast<int>(k), orientation[k]);
}

void RigidBody::complete_start(Field& field) const {
  const Field::ComponentRange rotation = field.place("rotation");
  Block& block = field.blocks()[rotation.block];
  if (rotation.components == 1 || block.space->owned_nodes() == 0) return;
  const int orientation = field.place("orientation").offset;
  Vec<3, double> turn, spin;
  Quaternion<double> start;
  for (int k = 0; k < 3; ++k) {
    turn[k] = block.now.value[rotation.offset + k] - block.old.value[rotation.offset + k];
    spin[k] = block.now.rate[rotation.offset + k];
  }
  std::copy_n(block.old.value.begin() + orientation, 4, start.c.begin());
  start = turned(start, turn);
  std::ranges::copy(start.c, block.now.value.begin() + orientation);
  if (time_order() < 2) return;
  const Vec<3, double> momentum = rotation_tensor(start) * (inertia_ * spin);
  std::ranges::copy(momentum.c, block.now.value.begin() + field.place("angular_momentum").offset);
}

void RigidBody::displace(int dimension, const double* motion, const double* arm, double* displacement) const {
  Vec<3, double> x, angle;
  for (int d = 0; d < dimension; ++d) x[d] = arm[d];
  Quaternion<double> orientation;
  if (dimension == 2) {
    angle[2] = motion[2];
    orientation = turned(no_rotation, angle);
  } else {
    std::copy_n(motion + 6, 4, orientation.c.begin());
  }
  const Vec<3, double> there = rotation_tensor(orientation) * x;
  for (int d = 0; d < dimension; ++d) displacement[d] = motion[d] + there[d] - x[d];
}

}  // namespace seam::solid
