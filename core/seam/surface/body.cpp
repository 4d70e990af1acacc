// SPDX-License-Identifier: BSD-3-Clause
#include "seam/surface/body.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "seam/base/diagnostics.hpp"
#include "seam/base/policy.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/plugin/registry.hpp"

namespace seam {
namespace {

void require_dimension(const Parameters& p, int dimension, int wanted) {
  if (dimension != wanted)
    throw Error(p.where(), fmt::format("a body '{}' needs a scene of dimension {}; this one has {}", p.type(),
                                       wanted, dimension));
}

/// Two sides of a polygon that cross between their ends.
std::optional<std::pair<int, int>> find_crossing(const Surface& polygon) {
  const auto end = [&](int side, int k) {
    return &polygon.points[2 * static_cast<std::size_t>(polygon.facets[2 * side + k])];
  };
  const auto turn = [](const double* a, const double* b, const double* c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  };
  for (int i = 0; i < polygon.facet_count(); ++i)
    for (int j = i + 2; j < polygon.facet_count(); ++j) {
      const double *a = end(i, 0), *b = end(i, 1), *c = end(j, 0), *d = end(j, 1);
      if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return std::pair(i, j);
    }
  return std::nullopt;
}

/// A shape that keeps its form.
class RigidShape : public BodyShape {
 public:
  [[nodiscard]] MovingSurface surface(const BodySetting& setting) const final {
    return
        [shape = outline(setting.background.dimension(), setting.meshes)](double) { return Surface(shape); };
  }

 private:
  [[nodiscard]] virtual Surface outline(int dimension, const MeshFinder& meshes) const = 0;
};

/// A regular polygon with the area of the circle: the radius of its corners is a little larger.
class Circle final : public RigidShape {
 public:
  explicit Circle(const Parameters& p) : p_(p) {}
  static Schema schema() {
    Schema s("A circle, as a regular polygon of the same area.");
    s.vector("centre", "its centre").unit("m");
    s.number("radius", "its radius").unit("m").above(0);
    s.integer("facets", "sides of the polygon").at_least(3).at_most(1000000).otherwise("720");
    return s;
  }
  [[nodiscard]] Surface outline(int dimension, const MeshFinder&) const override {
    require_dimension(p_, dimension, 2);
    const int n = static_cast<int>(p_.integer("facets"));
    require_within(n, policy().limits.facets, "facets", "facets of the circle", p_.where("facets"));
    const double step = 2 * std::numbers::pi / n;
    const double radius = p_.number("radius") * std::sqrt(step / std::sin(step));
    Surface s;
    for (int k = 0; k < n; ++k) {
      s.points.push_back(p_.vector("centre")[0] + radius * std::cos(step * k));
      s.points.push_back(p_.vector("centre")[1] + radius * std::sin(step * k));
      s.facets.insert(s.facets.end(), {k, (k + 1) % n});
    }
    return s;
  }

 private:
  Parameters p_;
};

/// An icosahedron, its triangles split in four again and again, on the sphere of the same volume.
class Sphere final : public RigidShape {
 public:
  explicit Sphere(const Parameters& p) : p_(p) {}
  static Schema schema() {
    Schema s("A sphere, as a subdivided icosahedron of the same volume.");
    s.vector("centre", "its centre").unit("m");
    s.number("radius", "its radius").unit("m").above(0);
    s.integer("refinements", "how often the 20 triangles are split in four")
        .at_least(0)
        .at_most(8)
        .otherwise("4");
    return s;
  }
  [[nodiscard]] Surface outline(int dimension, const MeshFinder&) const override {
    require_dimension(p_, dimension, 3);
    require_within(20 * std::pow(4.0, p_.integer("refinements")), policy().limits.facets, "facets",
                   "facets of the sphere", p_.where("refinements"));
    Surface s = icosahedron();
    for (long k = 0; k < p_.integer("refinements"); ++k) split(s);
    const double scale = p_.number("radius") * std::cbrt(4 * std::numbers::pi / 3 / volume(s));
    for (std::size_t i = 0; i < s.points.size(); ++i)
      s.points[i] = p_.vector("centre")[i % 3] + scale * s.points[i];
    return s;
  }

 private:
  static void add_on_unit_sphere(Surface& s, double x, double y, double z) {
    const double length = std::sqrt(x * x + y * y + z * z);
    s.points.insert(s.points.end(), {x / length, y / length, z / length});
  }
  static Surface icosahedron() {
    Surface s;
    s.dimension = 3;
    const double g = std::numbers::phi;
    for (const double a : {-1.0, 1.0})
      for (const double b : {-g, g}) {
        add_on_unit_sphere(s, 0, a, b);
        add_on_unit_sphere(s, a, b, 0);
        add_on_unit_sphere(s, b, 0, a);
      }
    // Its triangles are the triples of nearest neighbours, which lie 2/sqrt(1+g^2) apart.
    const double edge = 4 / (1 + g * g) * 1.01;
    const auto near = [&](int i, int j) {
      double square = 0;
      for (int d = 0; d < 3; ++d) square += std::pow(s.points[3 * i + d] - s.points[3 * j + d], 2);
      return square < edge;
    };
    for (int i = 0; i < 12; ++i)
      for (int j = i + 1; j < 12; ++j)
        for (int k = j + 1; k < 12; ++k) {
          if (!near(i, j) || !near(j, k) || !near(i, k)) continue;
          const bool outward = triple(s, i, j, k) > 0;
          s.facets.insert(s.facets.end(), {i, outward ? j : k, outward ? k : j});
        }
    return s;
  }
  static void split(Surface& s) {
    std::map<std::pair<int, int>, int> middle;
    const auto between = [&](int a, int b) {
      const auto [found, is_new] = middle.emplace(std::minmax(a, b), s.point_count());
      if (is_new) {
        const std::array<double, 3> sum{s.points[3 * a] + s.points[3 * b],
                                        s.points[3 * a + 1] + s.points[3 * b + 1],
                                        s.points[3 * a + 2] + s.points[3 * b + 2]};
        add_on_unit_sphere(s, sum[0], sum[1], sum[2]);
      }
      return found->second;
    };
    std::vector<int> facets;
    for (std::size_t f = 0; f < s.facets.size(); f += 3) {
      const int a = s.facets[f], b = s.facets[f + 1], c = s.facets[f + 2];
      const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
      facets.insert(facets.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    s.facets = std::move(facets);
  }
  /// Six times the volume of the tetrahedron with the origin.
  static double triple(const Surface& s, int i, int j, int k) {
    const double *a = &s.points[3 * i], *b = &s.points[3 * j], *c = &s.points[3 * k];
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  static double volume(const Surface& s) {
    double sum = 0;
    for (std::size_t f = 0; f < s.facets.size(); f += 3)
      sum += triple(s, s.facets[f], s.facets[f + 1], s.facets[f + 2]) / 6;
    return sum;
  }
  Parameters p_;
};

class Box final : public RigidShape {
 public:
  explicit Box(const Parameters& p) : p_(p) {}
  static Schema schema() {
    Schema s("A rectangle or cuboid, parallel to the axes before any motion.");
    s.vector("from", "its lowest corner").unit("m");
    s.vector("to", "its highest corner").unit("m");
    return s;
  }
  [[nodiscard]] Surface outline(int dimension, const MeshFinder&) const override {
    const auto &low = p_.vector("from"), &high = p_.vector("to");
    Surface s;
    s.dimension = dimension;
    for (int d = 0; d < dimension; ++d)
      if (low[d] >= high[d])
        throw Error(p_.where("to"),
                    fmt::format("the box has no extent in direction {}: from {} to {}", d, low[d], high[d]));
    const auto corner = [&](int code) {
      for (int d = 0; d < dimension; ++d) s.points.push_back((code >> d & 1) != 0 ? high[d] : low[d]);
    };
    if (dimension == 2) {
      for (const int code : {0, 1, 3, 2}) corner(code);
      s.facets = {0, 1, 1, 2, 2, 3, 3, 0};
    } else {
      for (int code = 0; code < 8; ++code) corner(code);
      s.facets = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    }
    return s;
  }

 private:
  Parameters p_;
};

class Outline final : public RigidShape {
 public:
  explicit Outline(const Parameters& p) : p_(p) {}
  static Schema schema() {
    Schema corner("A corner.");
    corner.vector("at", "its position").unit("m");
    Schema s("A polygon.");
    s.list("corners", "its corners, counter-clockwise", corner);
    return s;
  }
  [[nodiscard]] Surface outline(int dimension, const MeshFinder&) const override {
    require_dimension(p_, dimension, 2);
    Surface s;
    const auto& corners = p_.list("corners");
    const int n = static_cast<int>(corners.size());
    double twice_area = 0;
    for (int k = 0; k < n; ++k) {
      const auto &a = corners[k].vector("at"), &b = corners[(k + 1) % n].vector("at");
      s.points.insert(s.points.end(), {a[0], a[1]});
      s.facets.insert(s.facets.end(), {k, (k + 1) % n});
      twice_area += a[0] * b[1] - a[1] * b[0];
    }
    if (const auto crossing = find_crossing(s))
      throw Error(p_.where("corners"),
                  fmt::format("the outline crosses itself: its side from corner {} and that from corner {}",
                              crossing->first + 1, crossing->second + 1));
    if (n < 3 || twice_area <= 0)
      throw Error(p_.where("corners"),
                  fmt::format("an outline needs at least three corners in counter-clockwise order; these {} "
                              "enclose the area {}",
                              n, twice_area / 2));
    return s;
  }

 private:
  Parameters p_;
};

class MeshBody final : public RigidShape {
 public:
  explicit MeshBody(const Parameters& p) : p_(p) {}
  static Schema schema() {
    Schema s("The boundary of a mesh of the scene.");
    s.reference("mesh", "the mesh", "mesh");
    s.names("boundaries", "parts of its boundary; default all").naming("boundary").otherwise("[]");
    return s;
  }
  [[nodiscard]] Surface outline(int, const MeshFinder& meshes) const override {
    return body_boundary(*meshes(p_.text("mesh")), p_.names("boundaries")).surface;
  }

 private:
  Parameters p_;
};

template <class Type>
void add(Registry& registry, const std::string& name) {
  registry.add<BodyShape>("body", name, Type::schema(),
                          [](const Parameters& p, const Registry&) { return std::make_unique<Type>(p); });
}

}  // namespace

void register_bodies(Registry& registry) {
  add<Circle>(registry, "circle");
  add<Sphere>(registry, "sphere");
  add<Box>(registry, "box");
  add<Outline>(registry, "outline");
  add<MeshBody>(registry, "mesh");
}

}  // namespace seam
