// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/simulation.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "seam/base/stopwatch.hpp"
#include "seam/cut/cell_costs.hpp"
#include "seam/mesh/input/mesh_input.hpp"
#include "seam/run/derived.hpp"
#include "seam/run/progress.hpp"

namespace seam {

std::map<std::string, std::shared_ptr<const MeshData>> load_meshes(const Scene& scene) {
  std::map<std::string, std::shared_ptr<const MeshData>> meshes;
  for (const auto& [name, parameters] : scene.root.map("meshes"))
    meshes[name] = std::make_shared<MeshData>(load_mesh(parameters));
  return meshes;
}

std::map<std::string, MeshNames> mesh_names(
    const std::map<std::string, std::shared_ptr<const MeshData>>& meshes) {
  std::map<std::string, MeshNames> names;
  for (const auto& [name, mesh] : meshes) {
    for (const auto& entry : mesh->boundaries) names[name].boundaries.insert(entry.first);
    for (const auto& entry : mesh->regions) names[name].regions.insert(entry.first);
  }
  return names;
}

Simulation::Simulation(const Scene& scene, const Registry& registry, const Communicator& communicator)
    : scene_(scene), communicator_(communicator), problem_(communicator) {
  const Stopwatch watch;
  read_time();
  build_fields(registry);
  build_couplings(registry);
  const Parameters& solver = scene.root.object("solver");
  problem_.finish(time_.start, solver.object("newton").boolean("shape_derivatives"));
  linear_ = registry.create<LinearSolver>("linear_solver", solver.object("linear"));
  const Parameters& newton = solver.object("newton");
  newton_ = std::make_unique<Newton>(
      problem_, *linear_,
      NewtonOptions{newton.number("tolerance"), newton.number("increment_tolerance"),
                    static_cast<int>(newton.integer("maximum_iterations")), newton.boolean("damping")});
  for (const auto& [name, parameters] : scene.root.object("output").map("probes"))
    probes_.emplace_back(name, parameters, problem_);
  timings_.setup = watch.seconds();
}

void Simulation::read_time() {
  if (!scene_.root.has("time")) return;
  const Parameters& p = scene_.root.object("time");
  time_.is_static = p.boolean("static");
  time_.theta = p.number("theta");
  time_.start = p.number("start");
  time_.end = p.number("end");
  if (time_.end <= time_.start)
    throw Error(p.where("end"),
                fmt::format("the end {} does not come after the start {}", time_.end, time_.start));
  time_.initial = time_.maximum = time_.end - time_.start;
  if (p.has("step")) {
    const Parameters& step = p.object("step");
    time_.initial = time_.maximum = std::min(step.number("initial"), time_.end - time_.start);
    time_.adaptive = step.boolean("adaptive");
    if (time_.adaptive) time_.maximum = std::max(time_.initial, 0.1 * (time_.end - time_.start));
    if (step.has("maximum")) time_.maximum = step.number("maximum");
  }
  time_.minimum = 1e-6 * time_.initial;
  if (p.has("step") && p.object("step").has("minimum")) time_.minimum = p.object("step").number("minimum");
}

void Simulation::build_fields(const Registry& registry) {
  meshes_ = load_meshes(scene_);
  check_mesh_names(scene_, registry, mesh_names(meshes_));
  for (const auto& [name, parameters] : scene_.root.map("interfaces"))
    interfaces_.emplace_back(name, registry.create<Interface>("interface", parameters));
  std::map<std::string, std::shared_ptr<const Mesh>> meshes;
  for (const auto& [name, parameters] : scene_.root.map("fields")) {
    const std::string& mesh = parameters.text("mesh");
    if (!meshes.contains(mesh))
      meshes[mesh] = std::make_shared<Mesh>(mesh, meshes_.at(mesh), communicator_, cell_costs(mesh));
    problem_.add_field(name, meshes[mesh], registry.create<Physics>("field", parameters));
  }
}

/// What the cells of a mesh cost, from the bodies that cut it at the start; empty where they all cost the
/// same.
std::vector<double> Simulation::cell_costs(const std::string& mesh) const {
  if (communicator_.size() == 1) return {};
  std::vector<Surface> bodies;
  const MeshFinder find = [&](const std::string& name) { return meshes_.at(name); };
  for (const auto& [name, interface] : interfaces_)
    for (const auto& [field, parameters] : scene_.root.map("fields"))
      if (field == interface->fields().front() && parameters.text("mesh") == mesh)
        if (auto body = interface->body(find, meshes_.at(mesh)->dimension, time_.start))
          bodies.push_back(std::move(*body));
  return bodies.empty() ? std::vector<double>{} : cut_cell_costs(meshes_.at(mesh), bodies);
}

/// What an interface may ask of the scene while it is built.
class Simulation::Setup final : public InterfaceSetup {
 public:
  Setup(Simulation& simulation, const std::vector<std::string>& names) : simulation_(simulation) {
    int order = 1;
    for (const std::string& name : names) {
      entries_.push_back(&simulation.problem_.field(name));
      sides.push_back(entries_.back()->field.get());
      for (const Block& block : sides.back()->blocks()) order = std::max(order, block.space->order());
    }
    degree = 2 * order;
  }
  FieldCut& cut(int side) override { return simulation_.problem_.cut(*entries_[side]); }
  std::string displacement(int side) override {
    const Physics& physics = *entries_[side]->physics;
    return physics.support() == Support::mesh ? physics.displacement() : "";
  }
  std::shared_ptr<const MeshData> mesh(const std::string& name) override {
    return simulation_.meshes_.at(name);
  }

 private:
  Simulation& simulation_;
  std::vector<FieldEntry*> entries_;
};

void Simulation::build_couplings(const Registry& registry) {
  struct Built {
    std::shared_ptr<IntegrationDomain> domain;
    std::vector<Field*> sides;
  };
  std::map<std::string, Built> interfaces;
  for (const auto& [name, interface] : interfaces_) {
    Setup setup(*this, interface->fields());
    interfaces[name] = {interface->build(setup), setup.sides};
    problem_.name_interface(name, interfaces[name].domain);
  }
  for (const Parameters& parameters : scene_.root.list("coupling")) {
    const Built& built = interfaces.at(parameters.text("on"));
    const auto coupling = registry.create<Coupling>("coupling", parameters);
    std::vector<BoundTerm> terms;
    try {
      const CouplingSides sides{{built.sides.begin(), built.sides.end()}};
      for (const auto& term : coupling->terms(sides))
        terms.push_back(
            {term.term, term.operands, term.constant ? built.domain->add_constant(term.constant) : -1});
      for (const auto& mismatch : coupling->mismatches(sides))
        problem_.add_mismatch({parameters.text("on") + "." + mismatch.name,
                               built.domain,
                               {mismatch.quantity, mismatch.operands}});
      problem_.add_coupling(built.domain, std::move(terms));
    } catch (const Error& error) {
      throw Error(parameters.where(), error.what());
    }
  }
}

void Simulation::start(const RunOptions& options) {
  folder_ = options.folder;
  std::vector<std::string> damaged;
  const std::filesystem::path point = options.resume ? latest_restart(folder_ / "restart", damaged) : "";
  for (const std::string& warning : damaged)
    if (communicator_.rank() == 0) fmt::print(stderr, "warning: {}; an older one is used\n", warning);
  const bool resumed = !point.empty();
  if (resumed) {
    state_ = read_restart(point, problem_);
    problem_.update_spaces(time_point(state_.time, 0, time_.theta));
  } else {
    state_.time = time_.start;
    state_.step = time_.initial;
    problem_.initialise(time_.start, !time_.is_static);
    problem_.update_spaces(time_point(time_.start, 0, time_.theta));
    if (!time_.is_static && problem_.needs_initial_rates(time_.theta))
      newton_->solve_initial_rates(time_.start);
  }
  if (scene_.root.object("output").boolean("fields"))
    fields_ = std::make_unique<FieldOutput>(problem_, folder_, resumed ? state_.time : -1.0);
  if (communicator_.rank() == 0) std::filesystem::create_directories(folder_);
  if (resumed) return;
  const TimePoint at = time_point(time_.start, 0, time_.theta);
  problem_.assembler().assemble(at, false);
  record(at);
}

const Results& Simulation::run(const RunOptions& options) {
  run_watch_ = Stopwatch();
  start(options);
  double step = state_.step;
  long taken = 0;
  const double span = time_.end - time_.start;
  while (state_.time < time_.end - 1e-10 * span) {
    if (options.stop_after && taken++ == *options.stop_after) break;
    const double remaining = time_.end - state_.time;
    // No crumbs: a last step up to a hundredth longer or shorter than planned swallows them.
    const double tried = remaining < 1.01 * step ? remaining : step;
    if (try_step(tried)) {
      step = next_step(tried);
      state_.step = step;
      if (restart_due()) save_restart();
      show_progress(options, run_watch_.seconds());
      continue;
    }
    ++rejected_steps_;
    step = tried / 2;
    if (step < time_.minimum)
      throw Error(fmt::format("the step from t = {:.6g} fails down to a length of {:.2g}: {}", state_.time,
                              tried, reports_.back().reason));
  }
  if (state_.time >= time_.end - 1e-10 * span) finish_errors();
  finish_timings();
  return state_.results;
}

void Simulation::finish_timings() {
  timings_.pattern = problem_.assembler().pattern_seconds();
  timings_.assembly = problem_.assembler().assembly_seconds();
  timings_.total = run_watch_.seconds() + timings_.setup;
}

void Simulation::record_failure(const std::string& reason) {
  failure_ = reason;
  finish_timings();
  if (state_.results.time.empty()) return;  // it failed before there was a state
  problem_.update_spaces(last_point_);
  if (fields_ && last_fields_ != state_.step_number) write_fields(last_point_);
  save_restart();
}

/// One step; leaves everything as it was when it fails.
bool Simulation::try_step(double step) {
  const Problem::Snapshot before = problem_.snapshot();
  const double until =
      std::abs(state_.time + step - time_.end) < 1e-10 * step ? time_.end : state_.time + step;
  const double theta = state_.step_number == 0 && problem_.constrains_rates() ? 1 : time_.theta;
  const TimePoint at = time_point(until, time_.is_static ? 0 : step, theta);
  problem_.begin_step(at);
  try {
    reports_.push_back(newton_->solve(at));
  } catch (const StepRefused& refused) {
    problem_.restore(before);
    NewtonReport& report = reports_.emplace_back();
    report.reason = refused.what();
    return false;
  } catch (...) {
    problem_.restore(before);
    throw;
  }
  timings_.linear += reports_.back().linear_seconds;
  if (!reports_.back().converged) {
    problem_.restore(before);
    return false;
  }
  last_time_error_ = time_.adaptive && !time_.is_static ? time_error(at) : 0;
  state_.time = until;
  ++state_.step_number;
  record(at);
  return true;
}

/// Relative difference between the step and an explicit one that uses the old rate: half the step times the
/// change of the rate, which is the local error of the implicit Euler method.
double Simulation::time_error(const TimePoint& at) const {
  double worst = 0;
  for (const FieldEntry& entry : problem_.fields())
    for (const Block& block : entry.field->blocks()) {
      std::vector<double> sums(2, 0.0);
      for (std::size_t i = 0; i < static_cast<std::size_t>(block.space->owned_nodes()) * block.size; ++i) {
        if (block.time_order[i % block.size] == 0) continue;
        sums[0] += std::pow(0.5 * at.step * (block.now.rate[i] - block.old.rate[i]), 2);
        sums[1] += std::pow(block.now.value[i], 2);
      }
      communicator_.sum(sums);
      if (sums[1] > 0) worst = std::max(worst, std::sqrt(sums[0] / sums[1]));
    }
  return worst;
}

double Simulation::next_step(double tried) const {
  if (!time_.adaptive) {
    // After a failed step, return to the given grid of times.
    const double done = (state_.time - time_.start) / time_.initial;
    const double to_grid = (std::floor(done + 1 + 1e-9) - done) * time_.initial;
    return std::min(2 * tried, to_grid);
  }
  constexpr double tolerance = 1e-3, most = 1.5;
  double factor = most;
  if (last_time_error_ > 0) factor = std::clamp(0.9 * std::sqrt(tolerance / last_time_error_), 0.3, most);
  // A step that took many iterations should not be followed by a longer one.
  if (reports_.back().history.size() > 9) factor = std::min(factor, 0.7);
  return std::clamp(factor * tried, time_.minimum, time_.maximum);
}

void Simulation::record(const TimePoint& at) {
  const Stopwatch watch;
  state_.results.time.push_back(state_.time);
  for (const Probe& probe : probes_) probe.record(problem_, at, state_.results);
  record_integrals(problem_, at, state_.results);
  record_formulas(scene_, state_.results);
  const long every = scene_.root.object("output").integer("every");
  const bool last = state_.time >= time_.end;
  last_point_ = at;
  if (fields_ && (state_.step_number % every == 0 || last)) write_fields(at);
  if (communicator_.rank() == 0) write_series((folder_ / "series.csv").string(), state_.results);
  timings_.output += watch.seconds();
}

void Simulation::write_fields(const TimePoint& at) {
  fields_->write(state_.step_number, at);
  last_fields_ = state_.step_number;
}

bool Simulation::restart_due() const {
  const long every = scene_.root.object("output").object("restart").integer("every");
  return every != 0 && state_.step_number % every == 0;
}

void Simulation::save_restart() {
  const Stopwatch watch;
  const std::filesystem::path folder = folder_ / "restart";
  write_restart(folder / fmt::format("{:08}.restart", state_.step_number), problem_, state_, scene_.text);
  if (communicator_.rank() == 0)
    prune_restarts(folder, scene_.root.object("output").object("restart").integer("keep"));
  timings_.output += watch.seconds();
}

void Simulation::finish_errors() {
  for (const auto& [name, p] : scene_.root.object("output").map("errors")) {
    const FieldEntry& entry = problem_.field(p.text("field"));
    const auto& exact = p.vector_expression("exact");
    const auto gradient = p.has("gradient") ? p.vector_expression("gradient") : std::vector<Expression>{};
    const ErrorNorms norms =
        p.has("interface") ? interface_error_norms(*problem_.interfaces().at(p.text("interface")), entry,
                                                   p.text("unknown"), exact, gradient, state_.time)
                           : error_norms(entry, p.text("unknown"), exact, gradient, state_.time);
    state_.results.once[name + ".l2"] = norms.l2;
    if (norms.h1) state_.results.once[name + ".h1"] = *norms.h1;
  }
  finish_statistics(scene_, state_.results);
  std::vector<double> iterations;
  for (const NewtonReport& report : reports_)
    iterations.push_back(static_cast<double>(report.history.size()) - 1);
  std::sort(iterations.begin(), iterations.end());
  state_.results.once["newton.iterations.median"] =
      iterations.empty() ? 0 : iterations[iterations.size() / 2];
  state_.results.once["newton.iterations.most"] = iterations.empty() ? 0 : iterations.back();
  state_.results.once["unknowns"] = static_cast<double>(unknowns());
}

long long Simulation::unknowns() { return problem_.assembler().matrix().global_rows; }

void Simulation::show_progress(const RunOptions& options, double seconds) const {
  if (options.quiet || communicator_.rank() != 0) return;
  const double done = (state_.time - time_.start) / (time_.end - time_.start);
  print_progress(
      {state_.step_number, state_.time, static_cast<int>(reports_.back().history.size()) - 1, done, seconds});
}

}  // namespace seam
