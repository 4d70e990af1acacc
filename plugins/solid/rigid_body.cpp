// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_body.hpp"

#include "kernels.hpp"
#include "rotation.hpp"
#include "seam/physics/conditions.hpp"
#include "seam/term/kernel_term.hpp"

namespace seam::solid {
namespace {

using translation = Vector<0>;
using rotation = Rotation<1>;
const std::vector<std::string> unknown_names{"translation", "rotation"};

template <class T>
Vec<3, T> cross(const Vec<3, T>& a, const Vec<3, T>& b) {
  return skew(a) * b;
}

/// m d2x/dt2 and I d(omega)/dt + omega x I omega, in the directions of the unknowns.
struct RigidInertia {
  using Reads = Slots<Value<rotation>, Rate<rotation>, SecondRate<translation>, SecondRate<rotation>>;
  using Tests = Slots<Value<translation>, Value<rotation>>;
  double mass;                ///< kg
  Mat<3, 3, double> inertia;  ///< about the centre, in the reference position, kg m^2

  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(translation{}) += mass * s.second_rate(translation{});
    if constexpr (dim == 2) {
      r.value(rotation{}) += inertia(2, 2) * s.second_rate(rotation{});
    } else {
      const Vec<3, T> phi = s.value(rotation{}), rate = s.rate(rotation{});
      const Mat<3, 3, T> tangent = rotation_tangent(phi);
      // d(tangent)/dt along the motion, by one more derivative.
      Vec<3, Fad<1, T>> moving;
      for (int i = 0; i < 3; ++i) {
        moving[i] = Fad<1, T>(phi[i]);
        moving[i].d[0] = rate[i];
      }
      const auto moving_tangent = rotation_tangent(moving);
      Mat<3, 3, T> tangent_rate;
      for (int k = 0; k < 9; ++k) tangent_rate.c[k] = moving_tangent.c[k].d[0];
      const Vec<3, T> omega = tangent * rate;
      const Vec<3, T> acceleration = tangent * s.second_rate(rotation{}) + tangent_rate * rate;
      const Mat<3, 3, T> turn = rotation_tensor(phi);
      const Mat<3, 3, T> current = turn * (inertia * transpose(turn));
      r.value(rotation{}) += transpose(tangent) * (current * acceleration + cross<T>(omega, current * omega));
    }
  }
};

/// Springs and dashpots to the reference position, loads and weight.
struct RigidForces {
  using Reads = Slots<Value<translation>, Rate<translation>, Value<rotation>, Rate<rotation>>;
  using Tests = Slots<Value<translation>, Value<rotation>>;
  std::vector<double> stiffness, damping;           ///< per translation component, N/m, N s/m
  double rotational_stiffness, rotational_damping;  ///< N m, N m s
  std::vector<Expression> force, moment;            ///< N, N m; empty for none

  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const auto at = [&](const Expression& e) { return e(x.position.c.data(), dim, x.time); };
    const Vec<dim, T> d = s.value(translation{}), v = s.rate(translation{});
    Vec<dim, T> sum;
    for (int i = 0; i < dim; ++i) {
      sum[i] = stiffness[i] * d[i] + damping[i] * v[i];
      if (!force.empty()) sum[i] -= at(force[i]);
    }
    r.value(translation{}) += sum;
    if constexpr (dim == 2) {
      T turn = rotational_stiffness * s.value(rotation{}) + rotational_damping * s.rate(rotation{});
      if (!moment.empty()) turn -= at(moment[0]);
      r.value(rotation{}) += turn;
    } else {
      const Vec<3, T> phi = s.value(rotation{});
      const Mat<3, 3, T> tangent = rotation_tangent(phi);
      Vec<3, T> turn = rotational_stiffness * phi;
      Vec<3, T> spatial = rotational_damping * (tangent * s.rate(rotation{}));
      if (!moment.empty())
        for (int i = 0; i < 3; ++i) spatial[i] -= at(moment[i]);
      turn += transpose(tangent) * spatial;
      r.value(rotation{}) += turn;
    }
  }
};

/// 1/2 m |v|^2 + 1/2 omega . I omega, J.
struct RigidKineticEnergy {
  using Reads = Slots<Rate<translation>, Value<rotation>, Rate<rotation>>;
  static constexpr int values(int) { return 1; }
  RigidInertia body;
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    *value = 0.5 * body.mass * dot(s.rate(translation{}), s.rate(translation{}));
    if constexpr (dim == 2) {
      *value += 0.5 * body.inertia(2, 2) * s.rate(rotation{}) * s.rate(rotation{});
    } else {
      const Vec<3, double> phi = s.value(rotation{});
      const Vec<3, double> in_body =
          transpose(rotation_tensor(phi)) * (rotation_tangent(phi) * s.rate(rotation{}));
      *value += 0.5 * dot(in_body, body.inertia * in_body);
    }
  }
};

RigidInertia inertia_of(const Moments& moments, double density, int dim) {
  RigidInertia body{density * moments.volume, {}};
  const auto& m = moments.second;
  const double trace = m[0][0] + m[1][1] + (dim == 3 ? m[2][2] : 0.0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) body.inertia(i, j) = density * ((i == j ? trace : 0.0) - m[i][j]);
  return body;
}

}  // namespace

Schema RigidBody::schema() {
  Schema s(
      "Body that moves without deforming; each component of its motion is given or follows from the forces.");
  s.reference("mesh", "Its shape, in the reference position", "mesh");
  s.vector_expression("translation", "Motion of its centre; null leaves a component free, default all free")
      .unit("m")
      .optional();
  s.vector_expression("rotation", "Angle (2D) or rotation vector (3D) about its centre; null leaves it free")
      .unit("rad")
      .entries(-1)
      .optional();
  s.number("density", "Mass per volume; 0 for a body without inertia")
      .unit("kg/m^3")
      .otherwise("0")
      .at_least(0);
  s.vector("stiffness", "Springs that hold the centre, per direction").unit("N/m").optional();
  s.vector("damping", "Dashpots at the centre, per direction").unit("N s/m").optional();
  s.number("rotational_stiffness", "Spring against rotation").unit("N m").otherwise("0").at_least(0);
  s.number("rotational_damping", "Dashpot against rotation").unit("N m s").otherwise("0").at_least(0);
  s.vector_expression("force", "Load at the centre").unit("N").optional();
  s.vector_expression("moment", "Load: one entry in 2D, three in 3D").unit("N m").entries(-1).optional();
  s.vector_expression("body_force", "Force per mass, as gravity").unit("m/s^2").optional();
  Schema initial("Motion at the start");
  initial.vector("velocity", "Velocity of the centre").unit("m/s").optional();
  initial.vector("rotation_rate", "Rate of the rotation: one entry in 2D, three in 3D")
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
  Unknown rotation{"rotation", dimension == 2 ? 1 : 3, 1, time_order(), "rad"};
  rotation.scale = 1;
  return {{"translation", dimension, 1, time_order(), "m", UnknownRole::motion}, rotation};
}

void RigidBody::prescribe(FieldSetup& setup, const std::string& unknown) const {
  if (!parameters_.has(unknown)) return;
  const auto& values = parameters_.vector_expression(unknown);
  const std::size_t expected = unknown == "translation" ? setup.dimension() : setup.dimension() == 2 ? 1 : 3;
  if (values.size() != expected)
    throw Error(parameters_.where(unknown), "`" + unknown + "` needs " + std::to_string(expected) +
                                                " entries, found " + std::to_string(values.size()));
  prescribe_given(setup, parameters_, "", unknown);
}

void RigidBody::build(FieldSetup& setup) const {
  const int dim = setup.dimension();
  prescribe(setup, "translation");
  prescribe(setup, "rotation");
  const std::vector<double> none(dim, 0.0);
  RigidForces forces{
      parameters_.has("stiffness") ? parameters_.vector("stiffness") : none,
      parameters_.has("damping") ? parameters_.vector("damping") : none,
      parameters_.number("rotational_stiffness"),
      parameters_.number("rotational_damping"),
      parameters_.has("force") ? parameters_.vector_expression("force") : std::vector<Expression>{},
      parameters_.has("moment") ? parameters_.vector_expression("moment") : std::vector<Expression>{}};
  if (!forces.moment.empty() && forces.moment.size() != (dim == 2 ? 1u : 3u))
    throw Error(parameters_.where("moment"), "`moment` needs one entry in 2D, three in 3D");
  setup.add_cell_term(make_term(forces), unknown_names);

  const double density = parameters_.number("density");
  if (density > 0) {
    const RigidInertia body = inertia_of(setup.moments(), density, dim);
    setup.add_cell_term(make_term(body), unknown_names);
    setup.add_integral("kinetic_energy", make_quantity(RigidKineticEnergy{body}), unknown_names);
    if (parameters_.has("body_force"))
      setup.add_cell_term(make_term(BodyLoad{parameters_.vector_expression("body_force"), body.mass}),
                          unknown_names);
  }
  if (!parameters_.has("initial")) return;
  const Parameters& initial = parameters_.object("initial");
  for (const auto& [key, unknown] :
       {std::pair("velocity", "translation"), std::pair("rotation_rate", "rotation")})
    if (initial.has(key))
      for (std::size_t d = 0; d < initial.vector(key).size(); ++d)
        setup.set_initial_rate(unknown, static_cast<int>(d), Expression(initial.vector(key)[d]));
}

void RigidBody::displace(int dimension, const double* motion, const double* arm, double* displacement) const {
  Vec<3, double> phi, x;
  for (int d = 0; d < dimension; ++d) x[d] = arm[d];
  if (dimension == 2)
    phi[2] = motion[2];
  else
    for (int d = 0; d < 3; ++d) phi[d] = motion[3 + d];
  const Vec<3, double> turned = rotation_tensor(phi) * x;
  for (int d = 0; d < dimension; ++d) displacement[d] = motion[d] + turned[d] - x[d];
}

}  // namespace seam::solid
