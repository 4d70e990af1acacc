// SPDX-License-Identifier: BSD-3-Clause
// Functions that take their time, or end a run in ways that scenes cannot, and a linear solver that fails
// when it is told to: for the tests of what is left then.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

#include "seam/assembly/domains.hpp"
#include "seam/constraint/constraint.hpp"
#include "seam/interface/interface.hpp"
#include "seam/linear/linear_solver.hpp"
#include "seam/plugin/plugin.hpp"
#include "seam/run/interruption.hpp"
#include "seam/scene/function.hpp"
#include "seam/term/kernel_term.hpp"

namespace {

using seam::Function;
using seam::Parameters;

/// `slow.load` is a constant that takes some seconds to find out, once for each time, or as long as a test
/// wants to: then nothing depends on how fast the machine is.
class Slow final : public Function {
 public:
  explicit Slow(const Parameters& p)
      : seconds_(p.number("seconds")),
        load_(p.number("load")),
        from_(p.number("from")),
        begun_(p.has("begun") ? p.text("begun") : ""),
        until_(p.has("until") ? p.text("until") : "") {}
  [[nodiscard]] const std::vector<Member>& members() const override { return members_; }
  void evaluate(int /*part*/, const double* /*x*/, double t, double* value) const override {
    if (t != last_ && t > from_) wait();
    last_ = t;
    value[0] = load_;
  }

 private:
  void wait() const {
    using std::chrono::steady_clock;
    if (!begun_.empty()) std::ofstream{begun_};
    const auto end = steady_clock::now() + std::chrono::duration<double>(seconds_);
    if (until_.empty()) std::this_thread::sleep_until(end);
    while (!until_.empty() && !std::filesystem::exists(until_) && steady_clock::now() < end) {
      // Other ranks wait for this file, too.
      if (seam::SignalWatch::caught() != 0) std::ofstream{until_};
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  std::vector<Member> members_{{"load", 1}};
  double seconds_, load_, from_;
  std::string begun_, until_;
  mutable double last_ = 0;
};

/// `trouble.load` is a constant, until a time at which something happens.
class Trouble final : public Function {
 public:
  explicit Trouble(const Parameters& p)
      : at_(p.number("at")), load_(p.number("load")), what_(p.text("what")), rank_(p.text("rank")) {}
  [[nodiscard]] const std::vector<Member>& members() const override { return members_; }
  void evaluate(int /*part*/, const double* /*x*/, double t, double* value) const override {
    value[0] = load_;
    const char* rank = std::getenv("OMPI_COMM_WORLD_RANK");
    if (t < at_ || rank_ != (rank ? rank : "0")) return;
    if (what_ == "memory") throw std::bad_alloc();
    if (what_ == "death") std::raise(SIGKILL);
    throw std::runtime_error("the library below is out of sorts");
  }

 private:
  std::vector<Member> members_{{"load", 1}};
  double at_, load_;
  std::string what_, rank_;
};

/// Ties nothing, until a time at which it fails on one rank.
class TroubleWithTies final : public seam::Constraint {
 public:
  explicit TroubleWithTies(const Parameters& p) : at_(p.number("at")), rank_(p.text("rank")) {}
  void build(seam::ConstraintSetup& /*setup*/) override {}
  void tie(seam::Ties& /*ties*/, const seam::TimePoint& at) const override {
    const char* rank = std::getenv("OMPI_COMM_WORLD_RANK");
    if (at.time < at_ || rank_ != (rank ? rank : "0")) return;
    throw std::runtime_error("the knot came undone");
  }

 private:
  double at_;
  std::string rank_;
};

/// A boundary that on one rank fails in one of the calls that find its points, counted from 1.
class TroubleWithPoints final : public seam::IntegrationDomain {
 public:
  TroubleWithPoints(seam::BoundaryDomain inner, const Parameters& p)
      : inner_(std::move(inner)), in_(p.text("in")), call_(p.integer("call")), rank_(p.text("rank")) {}
  [[nodiscard]] int size() const override { return inner_.size(); }
  [[nodiscard]] std::vector<seam::Field*> fields() const override { return inner_.fields(); }
  void fill(int index, seam::Element& element) const override { inner_.fill(index, element); }
  [[nodiscard]] const int* nodes(int index, int side, int block) const override {
    return inner_.nodes(index, side, block);
  }
  [[nodiscard]] std::string description() const override { return inner_.description(); }
  void update(const seam::Field& field) override {
    fail_in("update");
    inner_.update(field);
  }
  bool follow(double /*time*/) override {
    fail_in("follow");
    return false;
  }

 private:
  void fail_in(const std::string& what) {
    const char* rank = std::getenv("OMPI_COMM_WORLD_RANK");
    if (what == in_ && ++calls_ == call_ && rank_ == (rank ? rank : "0"))
      throw std::runtime_error("the points went astray");
  }

  seam::BoundaryDomain inner_;
  std::string in_;
  long long call_, calls_ = 0;
  std::string rank_;
};

class TroubleWithInterface final : public seam::Interface {
 public:
  explicit TroubleWithInterface(const Parameters& p) : parameters_(p) {}
  [[nodiscard]] std::vector<std::string> fields() const override { return {parameters_.text("field")}; }
  [[nodiscard]] std::vector<seam::InterfacePart> build(seam::InterfaceSetup& setup) const override {
    return {{"", std::make_shared<TroubleWithPoints>(
                     seam::BoundaryDomain(*setup.sides[0], parameters_.text("boundary"), setup.degree),
                     parameters_)}};
  }

 private:
  Parameters parameters_;
};

/// <dv, v>
struct Drag {
  using velocity = seam::Vector<0>;
  using Reads = seam::Slots<seam::Value<velocity>>;
  using Tests = seam::Slots<seam::Value<velocity>>;
  template <int dim, class T>
  void operator()(const seam::Point<dim>& /*at*/, const seam::Trial<dim, T, Reads>& s,
                  seam::Test<dim, T, Tests>& r) const {
    r.value(velocity{}) += s.value(velocity{});
  }
};

class Brake final : public seam::Coupling {
 public:
  [[nodiscard]] std::vector<SideTerm> terms(const seam::CouplingSides& /*sides*/) const override {
    return {{seam::make_term(Drag{}), {{0, "velocity"}}}};
  }
};

/// Solves as another one does, but for one of its solves, which finds the matrix singular.
class Failing final : public seam::LinearSolver {
 public:
  Failing(const Parameters& p, const seam::Registry& registry)
      : inner_(registry.create<LinearSolver>("linear_solver", p.object("by"))), at_(p.integer("at")) {}
  void forget() override { inner_->forget(); }

 protected:
  void solve_into(const seam::Matrix& a, const std::vector<seam::EquationBlock>& blocks,
                  const std::vector<double>& b, std::vector<double>& x, seam::SolveReport& report) override {
    if (++count_ == at_) throw seam::SingularMatrix("the matrix of this solve is singular", {});
    report = inner_->solve(a, blocks, b, x);
  }

 private:
  std::unique_ptr<LinearSolver> inner_;
  long long at_, count_ = 0;
};

}  // namespace

SEAM_PLUGIN(registry) {
  seam::Schema slow("A load that takes its time.");
  slow.number("seconds", "taken once for each time").at_least(0);
  slow.number("load", "its value");
  slow.number("from", "the time after which it is taken").otherwise("0");
  slow.text("begun", "a file that is made when it begins to be taken").optional();
  slow.text("until", "a file that ends it; a signal that is caught makes it").optional();
  registry.add<Function>(
      "function", "slow", slow,
      [](const Parameters& p, const seam::Registry& /*registry*/) { return std::make_unique<Slow>(p); });
  seam::Schema trouble("A load that ends the run.");
  trouble.number("at", "when");
  trouble.number("load", "its value until then");
  trouble.choice("what", "happens", {"exception", "memory", "death"});
  trouble.text("rank", "to which it happens").otherwise("0");
  registry.add<Function>(
      "function", "trouble", trouble,
      [](const Parameters& p, const seam::Registry& /*registry*/) { return std::make_unique<Trouble>(p); });
  seam::Schema ties("A constraint that ends the run.");
  ties.number("at", "when");
  ties.text("rank", "to which it happens").otherwise("0");
  registry.add<seam::Constraint>("constraint", "trouble", ties,
                                 [](const Parameters& p, const seam::Registry& /*registry*/) {
                                   return std::make_unique<TroubleWithTies>(p);
                                 });
  seam::Schema points("A boundary that ends the run.");
  points.reference("field", "the field", "field");
  points.text("boundary", "the boundary of its mesh");
  points.choice("in", "what fails", {"update", "follow"});
  points.integer("call", "the call that fails, counted from 1");
  points.text("rank", "on which it fails").otherwise("0");
  registry.add<seam::Interface>("interface", "trouble", points,
                                [](const Parameters& p, const seam::Registry& /*registry*/) {
                                  return std::make_unique<TroubleWithInterface>(p);
                                });
  seam::Schema brake("A drag.");
  brake.reference("on", "where", "interface");
  registry.add<seam::Coupling>(
      "coupling", "trouble", brake,
      [](const Parameters& /*p*/, const seam::Registry& /*all*/) { return std::make_unique<Brake>(); });
  seam::Schema failing("A solver that fails once.");
  failing.integer("at", "the solve that fails, counted from 1");
  failing.typed("by", "what solves the others", "linear_solver").otherwise("direct");
  registry.add<seam::LinearSolver>(
      "linear_solver", "failing", failing,
      [](const Parameters& p, const seam::Registry& all) { return std::make_unique<Failing>(p, all); });
}
