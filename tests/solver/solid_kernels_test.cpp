// SPDX-License-Identifier: BSD-3-Clause
// Stresses of the solid at single points: derivatives of the stored energy, and pressure on a surface that
// turns.
#include <catch2/catch.hpp>
#include <random>

#include "materials.hpp"
#include "quantities.hpp"
#include "solver/one_point.hpp"

using namespace seam;
using namespace seam::solid;

namespace {

using Tensor = Mat<3, 3, double>;

std::vector<PotentialPointer> materials() {
  Registry registry;
  declare_materials(registry);
  Parameters p;
  p.set("young", {10.0, {}, {}, true});
  p.set("poisson", {0.3, {}, {}, true});
  p.set("stiffening", {4.0, {}, {}, true});
  p.set("exponent", {4L, {}, {}, true});
  std::vector<PotentialPointer> all;
  for (const std::string& name : registry.names("hyperelastic")) {
    p.set_type(name);
    all.push_back(registry.create<Potential>("hyperelastic", p));
  }
  return all;
}

/// A displacement gradient without any symmetry; of the plane where dim is 2.
Tensor displacement_gradient(int dim, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(-0.3, 0.3);
  Tensor g;
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < dim; ++k) g(i, k) = part(random);
  return g;
}

/// Energy of a deformation gradient in space, by the invariants' definitions.
double energy(const Potential& material, const Tensor& f) {
  const Tensor c = transpose(f) * f;
  const double first = trace(c);
  const double x[3] = {first, 0.5 * (first * first - inner(c, c)), determinant(f)};
  double value, slope[3], curvature[9];
  material.evaluate(x, value, slope, curvature);
  return value;
}

template <class Function>
double slope(const Function& function) {
  constexpr double h = 1e-3;  // fourth order
  return (8 * (function(h) - function(-h)) - function(2 * h) + function(-2 * h)) / (12 * h);
}

/// d(function)/dF, entry by entry.
template <class Function>
Tensor gradient_of(const Function& function, const Tensor& f) {
  Tensor result;
  for (int k = 0; k < 9; ++k)
    result.c[k] = slope([&](double h) {
      Tensor moved = f;
      moved.c[k] += h;
      return function(moved);
    });
  return result;
}

template <int dim>
Mat<dim, dim, double> part_of(const Tensor& a) {
  Mat<dim, dim, double> r;
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < dim; ++k) r(i, k) = a(i, k);
  return r;
}

template <int dim>
void check_cauchy_stress(const Potential& material) {
  const Tensor g = displacement_gradient(dim, 5), f = g + identity<3>();
  const Tensor piola = gradient_of([&](const Tensor& at) { return energy(material, at); }, f);
  const Tensor expected = (1 / determinant(f)) * (piola * transpose(f));
  const auto sigma = cauchy_stress<dim>(material, part_of<dim>(g));
  const int row[] = {0, 1, 2, 0, 1, 0}, column[] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; ++k) {
    INFO("entry " << row[k] << column[k] << " in " << dim << " dimensions");
    CHECK(sigma[k] == Approx(expected(row[k], column[k])).epsilon(1e-7).margin(1e-8));
  }
}

}  // namespace

TEST_CASE("Cauchy stresses are derivatives of the energy, out of the plane too") {
  for (const PotentialPointer& material : materials()) {
    check_cauchy_stress<2>(*material);
    check_cauchy_stress<3>(*material);
  }
}

TEST_CASE("a stiffening solid in compression without lateral strain has the stress of a formula") {
  Registry registry;
  declare_materials(registry);
  Parameters p;
  p.set_type("stiffening_neo_hookean");
  p.set("young", {10.0, {}, {}, true});
  p.set("poisson", {0.0, {}, {}, true});
  p.set("stiffening", {4.0, {}, {}, true});
  p.set("exponent", {3L, {}, {}, true});
  CHECK_THROWS_WITH(registry.create<Potential>("hyperelastic", p), Catch::Matchers::Contains("even"));
  p.set("exponent", {8L, {}, {}, true});
  const PotentialPointer material = registry.create<Potential>("hyperelastic", p);
  const double stretch = 0.7;
  const auto sigma = cauchy_stress<2>(*material, Mat<2, 2, double>{{0, 0, 0, stretch - 1}});
  const double expected =
      5 * (stretch - 1 / stretch) + 4.0 * 8 * std::pow(stretch * stretch - 1, 7) * 2 * stretch;
  CHECK(sigma[1] == Approx(expected).epsilon(1e-13));
}

TEST_CASE("von Mises' stress is that of a bar under any rotation, and of pure shear") {
  // Yield under shear is by the square root of three below that under tension.
  CHECK(von_mises({7, 0, 0, 0, 0, 0}) == Approx(7).epsilon(1e-14));
  CHECK(von_mises({7, 7, 7, 0, 0, 0}) == Approx(0).margin(1e-14));
  for (int shear = 3; shear < 6; ++shear) {
    std::array<double, 6> stress{};
    stress[shear] = 7;
    CHECK(von_mises(stress) == Approx(7 * std::sqrt(3)).epsilon(1e-14));
  }
  // Tension along an axis turned about z: half of it on the diagonal, half of it shear.
  CHECK(von_mises({3.5, 3.5, 0, 3.5, 0, 0}) == Approx(7).epsilon(1e-14));
}

TEST_CASE("the mixed form is the stationary point of its energy") {
  const int dim = GENERATE(2, 3);
  const double pressure = 0.7, theta = 1.15;
  for (const PotentialPointer& material : materials()) {
    const Tensor g = displacement_gradient(dim, 8), f = g + identity<3>();
    const auto potential = [&](const Tensor& at, double p, double dilated) {
      const double j = determinant(at);
      return energy(*material, std::cbrt(dilated / j) * at) + p * (j - dilated);
    };
    const Tensor stress = gradient_of([&](const Tensor& at) { return potential(at, pressure, theta); }, f);
    std::vector<double> in;
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < dim; ++k) in.push_back(g(i, k));
    in.insert(in.end(), {pressure, theta - 1});
    const std::vector<double> r = test::residual(*make_term(MixedInternalForce{material}), dim, in);
    const auto same = [](double found, double expected) {
      CHECK(found == Approx(expected).epsilon(1e-7).margin(1e-8));
    };
    REQUIRE(r.size() == in.size());
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < dim; ++k) same(r[i * dim + k], stress(i, k));
    same(r[dim * dim], slope([&](double h) { return potential(f, pressure + h, theta); }));
    same(r[dim * dim + 1], slope([&](double h) { return potential(f, pressure, theta + h); }));
  }
}

TEST_CASE("the mean stress of the mixed form is its pressure, the rest that of the material") {
  const int dim = GENERATE(2, 3);
  const double pressure = 0.7;
  for (const PotentialPointer& material : materials()) {
    const Tensor g = displacement_gradient(dim, 8);
    std::vector<double> in;
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < dim; ++k) in.push_back(g(i, k));
    // Where the dilation is that of the displacement.
    in.insert(in.end(), {pressure, determinant(g + identity<3>()) - 1});
    const auto found = test::at_one_point(*make_quantity(MixedCauchyStress{material}), dim, in, 6);
    const auto plain = dim == 2 ? cauchy_stress<2>(*material, part_of<2>(g)) : cauchy_stress<3>(*material, g);
    const double mean = (plain[0] + plain[1] + plain[2]) / 3;
    for (int k = 0; k < 6; ++k)
      CHECK(found[k] == Approx(plain[k] + (k < 3 ? pressure - mean : 0)).epsilon(1e-12).margin(1e-13));
    std::array<double, 6> stress{};
    std::copy(found.begin(), found.end(), stress.begin());
    CHECK(test::at_one_point(*make_quantity(MixedVonMises{{material}}), dim, in, 1)[0] ==
          Approx(von_mises(stress)).epsilon(1e-12));
    // Where it is another one, the rest is that of a body of this dilation with the same shape.
    const double dilation = 0.4, volume = determinant(g + identity<3>());
    in.back() = dilation;
    const auto swollen = test::at_one_point(*make_quantity(MixedCauchyStress{material}), dim, in, 6);
    const auto shaped =
        cauchy_stress<3>(*material, std::cbrt((1 + dilation) / volume) * (g + identity<3>()) - identity<3>());
    const double mean_of_shaped = (shaped[0] + shaped[1] + shaped[2]) / 3;
    for (int k = 0; k < 6; ++k)
      CHECK(swollen[k] ==
            Approx(shaped[k] + (k < 3 ? pressure - mean_of_shaped : 0)).epsilon(1e-12).margin(1e-13));
  }
}

TEST_CASE("pressure pushes across the surface as it lies now") {
  const Tensor g = displacement_gradient(3, 3), f = g + identity<3>();
  const auto push = make_term(FollowerPressure{Expression(2.0)});
  SECTION("in space: the area that two edges span") {
    // Their cross product is the normal of the reference surface.
    const Vec<3, double> normal{{2.0 / 7, 3.0 / 7, -6.0 / 7}},
        a{{3 / std::sqrt(13.0), -2 / std::sqrt(13.0), 0}};
    const auto cross = [](const Vec<3, double>& x, const Vec<3, double>& y) {
      return Vec<3, double>{
          {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]}};
    };
    const Vec<3, double> b = cross(normal, a), area = cross(f * a, f * b);
    const auto r = test::residual(*push, 3, {g.c.begin(), g.c.end()}, {normal.c.begin(), normal.c.end()});
    for (int i = 0; i < 3; ++i) CHECK(r[i] == Approx(2 * area[i]).epsilon(1e-13));
  }
  SECTION("in the plane: the edge, turned outwards") {
    const Vec<2, double> edge = part_of<2>(f) * Vec<2, double>{{-0.8, 0.6}};
    const auto r = test::residual(*push, 2, {g(0, 0), g(0, 1), g(1, 0), g(1, 1)}, {0.6, 0.8});
    CHECK(r[0] == Approx(2 * edge[1]).epsilon(1e-13));
    CHECK(r[1] == Approx(-2 * edge[0]).epsilon(1e-13));
  }
}

TEST_CASE("an elastic support has a stiffness for each direction") {
  for (const int dim : {2, 3}) {
    const std::vector<double> stiffness{2, 3, 5}, at{0.7, -0.4, 0.3};
    const auto push = test::residual(*make_term(solid::Support{{stiffness.begin(), stiffness.begin() + dim}}),
                                     dim, {at.begin(), at.begin() + dim});
    REQUIRE(push.size() == static_cast<std::size_t>(dim));
    for (int i = 0; i < dim; ++i) CHECK(push[i] == Approx(stiffness[i] * at[i]));
  }
}
