// SPDX-License-Identifier: BSD-3-Clause
// A field of heat conduction that goes wrong in the way its scene asks for, to see what Seam and the
// conformance kit say of it.
#include <cmath>
#include <csignal>
#include <memory>
#include <stdexcept>

#include "seam/constraint/constraint.hpp"
#include "seam/field/field.hpp"
#include "seam/physics/physics.hpp"
#include "seam/plugin/plugin.hpp"
#include "seam/scene/function.hpp"
#include "seam/term/kernel_term.hpp"

namespace {

using namespace seam;
using Temperature = Scalar<0>;

constexpr double late = 0.6;  // s: by then the run has taken some steps

struct Conduction {
  using Reads = Slots<Value<Temperature>, Rate<Temperature>, Gradient<Temperature>>;
  using Tests = Slots<Value<Temperature>, Gradient<Temperature>>;
  std::string how;

  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const T t = s.value(Temperature{});
    T conductivity = 1.0 + 0.3 * t * t;
    if (x.time > late) {
      if (how == "throws") throw std::runtime_error("the table ends at 5 K");
      if (how == "throws error") throw Error("the table ends at 5 K");
      if (how == "throws number") throw 42;
      if (how == "crashes") std::raise(SIGSEGV);
    }
    using std::sqrt;
    if (how == "slope at rest")
      conductivity = 1.0 + sqrt(dot(s.gradient(Temperature{}), s.gradient(Temperature{})));
    r.value(Temperature{}) += s.rate(Temperature{}) - 1.0;
    r.gradient(Temperature{}) += conductivity * s.gradient(Temperature{});
  }
};

/// Acts where it is hot: in the scene, nowhere.
struct Radiation {
  using Reads = Slots<Value<Temperature>>;
  using Tests = Slots<Value<Temperature>>;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const T t = s.value(Temperature{});
    if (plain(t) > 1000) r.value(Temperature{}) += t * t * t * t;
  }
};

/// Speaks of one unknown more than there is room for.
struct Crowd {
  using Reads = Slots<Value<Scalar<32>>>;
  using Tests = Slots<Value<Scalar<32>>>;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(Scalar<32>{}) += s.value(Scalar<32>{});
  }
};

template <int count>
struct Numbers {
  using Reads = Slots<Value<Temperature>>;
  static constexpr int values(int) { return count; }
  std::string how = {};
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* v) const {
    if (how == "quantity throws") throw std::out_of_range("no such row");
    for (int k = 0; k < count; ++k) v[k] = s.value(Temperature{});
  }
};

/// t^2 + t, with rates that may be those of 2 t^2 + t, or those of the half of it.
class Warming final : public Function {
 public:
  explicit Warming(const std::string& how)
      : first_(how == "rate" ? 2 : 1), second_(how == "second rate" ? 1 : 2) {}
  [[nodiscard]] const std::vector<Member>& members() const override {
    static const std::vector<Member> parts{{"heat", 1}};
    return parts;
  }
  void evaluate(int, const double*, double t, double* value) const override { *value = t * t + t; }
  void rates(int, const double*, double t, double* rate, double* second_rate) const override {
    *rate = first_ * 2 * t + 1;
    *second_rate = second_;
  }

 private:
  double first_, second_;
};

class Faulty final : public Physics {
 public:
  explicit Faulty(const Parameters& p) : how_(p.text("how")), where_(p.where()) {
    if (how_ == "constructor throws") throw std::out_of_range("no such row");
    if (how_ == "constructor crashes") std::raise(SIGSEGV);
    if (how_ == "undeclared key") (void)p.number("conductivity");
  }
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override {
    Unknown temperature{"temperature", 1, 1, 1, "K"};
    if (how_ == "order") temperature.order = 3;
    if (how_ == "components") temperature.components = 0;
    if (how_ == "time order") temperature.time_order = 5;
    if (how_ == "no rate") temperature.time_order = 0;
    if (how_ == "no name") temperature.name = "";
    if (how_ == "twice") return {temperature, temperature};
    return {temperature};
  }
  void build(FieldSetup& setup) const override {
    std::vector<std::string> operands{"temperature"};
    if (how_ == "few operands") operands = {};
    if (how_ == "many operands") operands = {"temperature", "temperature"};
    if (how_ == "crowd") setup.add_cell_term(make_term(Crowd{}), std::vector<std::string>(33, "temperature"));
    if (how_ == "unknown operand") operands = {"temprature"};
    if (how_ == "null term") setup.add_cell_term(nullptr, operands);
    if (how_ == "null quantity") setup.add_output("heat", nullptr, operands);
    if (how_ == "quantity as term") setup.add_cell_term(make_quantity(Numbers<1>{}), operands);
    if (how_ == "term as quantity") setup.add_output("heat", make_term(Radiation{}), operands);
    if (how_ == "build throws") throw std::runtime_error("stoi");
    setup.add_cell_term(make_term(Conduction{how_}), operands);
    if (how_ == "nothing") setup.add_cell_term(make_term(Radiation{}), operands);
    const Expression zero(0.0);
    if (how_ == "prescribes") setup.prescribe("x_min", "temperature", 7, zero, where_);
    if (how_ == "prescribes before") setup.prescribe("x_min", "temperature", -1, zero, where_);
    if (how_ == "starts") setup.set_initial("temperature", 1, zero);
    if (how_ == "starts rate") setup.set_initial_rate("temperature", 1, zero);
    if (how_ == "gives") setup.give("temperature", 1, zero);
    const bool warms = how_ == "rate" || how_ == "second rate" || how_ == "warms";
    setup.prescribe("x_min", "temperature", 0,
                    warms ? Expression::components(std::make_shared<Warming>(how_), 0)[0] : zero, where_);
    if (how_ == "output throws")
      setup.add_output("two", make_quantity(Numbers<2>{"quantity throws"}), {"temperature"});
    setup.add_integral("heat", make_quantity(Numbers<1>{how_}), {"temperature"});
  }

 private:
  std::string how_;
  Location where_;
};

/// c_a = (1 + t/10) c_b + c_b^2/2 between two nodes, told wrongly.
class Crooked final : public Constraint {
 public:
  explicit Crooked(std::string how) : how_(std::move(how)) {}
  void build(ConstraintSetup& setup) override { field_ = &setup.field("plate"); }
  void tie(Ties& ties, const TimePoint& at) const override {
    if (how_ == "throws") throw std::runtime_error("no such row");
    const int master = 7, tied = 17;  // of the 25 nodes, none on the edge that is held
    const double v = field_->blocks()[0].now.value[master], by_time = 0.1;
    const UnknownPlace to = ties.place(*field_, 0, master, 0), clock = UnknownPlace::clock();
    const double slope = 1 + by_time * at.time + (how_ == "slope" ? 2 * v : v);
    const double value = (1 + by_time * at.time) * v + v * v / 2 + (how_ == "remembers" ? 1e-3 * before_ : 0);
    before_ = v + before_ / 2;  // of more than the last time it was asked
    ties.tie(ties.place(*field_, 0, tied, 0),
             {{to, slope, how_ == "rate" ? 2 * slope : slope},
              {clock, 0, (how_ == "clock" ? 2 : 1) * by_time * v}},
             value - slope * v);
    const double curvature = how_ == "slope" || how_ == "rate" ? 2 : 1;
    if (how_ != "change") ties.add_change(to, to, curvature, how_ == "motion" ? 2 : curvature);
    ties.add_change(to, clock, by_time);
    ties.add_change(clock, to, by_time);
  }

 private:
  std::string how_;
  Field* field_ = nullptr;
  mutable double before_ = 0;
};

class Undefined final : public Physics {
 public:
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override { return {}; }
  void build(FieldSetup&) const override {}
};

}  // namespace

SEAM_PLUGIN(registry) {
  Schema schema("Heat conduction that goes wrong.");
  schema.reference("mesh", "its shape", "mesh");
  schema.text("how", "in which way");
  registry.add<Physics>("field", "faulty", schema,
                        [](const Parameters& p, const Registry&) { return std::make_unique<Faulty>(p); });
  Schema crooked("A relation that goes wrong.");
  crooked.text("how", "in which way");
  registry.add<Constraint>("constraint", "crooked", crooked, [](const Parameters& p, const Registry&) {
    return std::make_unique<Crooked>(p.text("how"));
  });
  Schema targets("Keys that point nowhere.");
  targets.reference("mesh", "its shape", "mesh");
  targets.reference("planet", "no thing of a scene", "planet").otherwise("mars");
  targets.names("where", "no parts of a mesh").naming("boundry").optional();
  targets.typed("law", "a kind without types", "laws_of_nature").optional();
  registry.add<Physics>("field", "pointless", targets,
                        [](const Parameters&, const Registry&) { return std::make_unique<Undefined>(); });
}
