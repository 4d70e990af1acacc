// SPDX-License-Identifier: BSD-3-Clause
// Where things are: a shape that is cut out of a mesh, an interface on a boundary with a coupling to act
// there, and a known flow.
#include <cmath>
#include <numbers>

#include "seam/assembly/domains.hpp"
#include "seam/interface/interface.hpp"
#include "seam/plugin/plugin.hpp"
#include "seam/scene/function.hpp"
#include "seam/term/kernel_term.hpp"

namespace {

using namespace seam;

/// An ellipse as a polygon of the same area.
class Ellipse final : public BodyShape {
 public:
  explicit Ellipse(const Parameters& p) {
    if (p.dimension() != 2) throw Error(p.where(), "an ellipse lies in the plane");
    const int n = static_cast<int>(p.integer("facets"));
    const double step = 2 * std::numbers::pi / n, grow = std::sqrt(step / std::sin(step));
    for (int k = 0; k < n; ++k) {
      for (int d = 0; d < 2; ++d) {
        const double part = d == 0 ? std::cos(step * k) : std::sin(step * k);
        surface_.points.push_back(p.vector("centre")[d] + grow * p.vector("semi_axes")[d] * part);
      }
      surface_.facets.insert(surface_.facets.end(), {k, (k + 1) % n});
    }
  }
  static Schema schema() {
    Schema s("An ellipse along the axes.");
    s.vector("centre", "Its centre").unit("m");
    s.vector("semi_axes", "Half of its width and height").unit("m");
    s.integer("facets", "Sides of the polygon that stands for it").otherwise("120").at_least(3);
    return s;
  }
  [[nodiscard]] MovingSurface surface(const BodySetting&) const override {
    return [surface = surface_](double) { return surface; };
  }

 private:
  Surface surface_;
};

/// A boundary of a field's mesh, for couplings.
class Wall final : public Interface {
 public:
  explicit Wall(const Parameters& p) : field_(p.text("field")), boundary_(p.text("boundary")) {}
  static Schema schema() {
    Schema s("A boundary of a field's mesh, for couplings to act on.");
    s.reference("field", "The field", "field");
    s.text("boundary", "The boundary of its mesh");
    return s;
  }
  [[nodiscard]] std::vector<std::string> fields() const override { return {field_}; }
  [[nodiscard]] std::vector<InterfacePart> build(InterfaceSetup& setup) const override {
    return {{"", std::make_shared<BoundaryDomain>(*setup.sides[0], boundary_,
                                                  setup.degree + setup.extra_degree)}};
  }

 private:
  std::string field_, boundary_;
};

/// <dv, c v>
struct Drag {
  using velocity = Vector<0>;
  using Reads = Slots<Value<velocity>>;
  using Tests = Slots<Value<velocity>>;
  double drag;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(velocity{}) += drag * s.value(velocity{});
  }
};

class Brake final : public Coupling {
 public:
  explicit Brake(const Parameters& p) : drag_(p.number("drag")) {}
  static Schema schema() {
    Schema s("Holds a fluid back in proportion to its velocity.");
    s.reference("on", "Interface with the fluid on side 0", "interface").of_types({"wall"});
    s.number("drag", "Traction per velocity").unit("Pa s/m").at_least(0);
    return s;
  }
  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides&) const override {
    return {{make_term(Drag{drag_}), {{0, "velocity"}}}};
  }

 private:
  double drag_;
};

/// The flow between a wall at rest at y = 0 and one that a traction drags and a brake holds back.
class Couette final : public Function {
 public:
  explicit Couette(const Parameters& p)
      : rate_(p.number("traction") / (p.number("viscosity") + p.number("drag") * p.number("height"))) {}
  static Schema schema() {
    Schema s("Couette flow to a wall with a traction and a drag; has `velocity`.");
    s.number("traction", "On the upper wall").unit("Pa");
    s.number("viscosity", "Of the fluid").unit("Pa s");
    s.number("drag", "Of the upper wall").unit("Pa s/m");
    s.number("height", "Of the upper wall").unit("m");
    return s;
  }
  [[nodiscard]] const std::vector<Member>& members() const override {
    static const std::vector<Member> all{{"velocity", 2}};
    return all;
  }
  void evaluate(int, const double* x, double, double* value) const override {
    value[0] = rate_ * x[1];
    value[1] = 0;
  }

 private:
  double rate_;
};

}  // namespace

SEAM_PLUGIN(registry) {
  registry.add<BodyShape>("body", "ellipse", Ellipse::schema(),
                          [](const Parameters& p, const Registry&) { return std::make_unique<Ellipse>(p); });
  registry.add<Interface>("interface", "wall", Wall::schema(),
                          [](const Parameters& p, const Registry&) { return std::make_unique<Wall>(p); });
  registry.add<Coupling>("coupling", "brake", Brake::schema(),
                         [](const Parameters& p, const Registry&) { return std::make_unique<Brake>(p); });
  registry.add<Function>("function", "couette", Couette::schema(),
                         [](const Parameters& p, const Registry&) { return std::make_unique<Couette>(p); });
}
