// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/simulation.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "seam/base/all_or_none.hpp"
#include "seam/base/memory.hpp"
#include "seam/base/plugin_fault.hpp"
#include "seam/base/policy.hpp"
#include "seam/base/stopwatch.hpp"
#include "seam/cut/cell_costs.hpp"
#include "seam/mesh/input/mesh_input.hpp"
#include "seam/run/derived.hpp"
#include "seam/run/error_list.hpp"
#include "seam/run/error_norms.hpp"
#include "seam/run/interruption.hpp"
#include "seam/run/progress.hpp"
#include "seam/run/result_names.hpp"
#include "seam/run/scene_doubts.hpp"
#include "seam/scene/resolved.hpp"

namespace seam {

std::map<std::string, std::shared_ptr<const MeshData>> load_meshes(const Scene& scene) {
  std::map<std::string, std::shared_ptr<const MeshData>> meshes;
  std::string errors;
  for (const auto& [name, parameters] : scene.root.map("meshes")) {
    try {
      meshes[name] =
          needing_memory(fmt::format("the mesh '{}'", name), parameters.where(),
                         [&, &of = parameters] { return std::make_shared<MeshData>(load_mesh(of)); });
    } catch (const OutOfMemory&) {
      throw;
    } catch (const Error& error) {
      errors += (errors.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  if (!errors.empty()) throw Error(errors);
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
    : scene_(scene), communicator_(communicator), problem_(communicator), stepper_(scene) {
  const Stopwatch watch;
  warnings_ = scene.warnings;
  // It reads the files that the scene names: once, by the rank that writes the summary.
  if (communicator.rank() == 0) resolved_checksum_ = resolved_checksum(resolve(scene, registry));
  build_fields(registry);
  build_couplings(registry);
  const Parameters& solver = scene.root.object("solver");
  problem_.finish(stepper_.start(), solver.object("newton").boolean("shape_derivatives"));
  linear_ = registry.create<LinearSolver>("linear_solver", solver.object("linear"));
  const Parameters& newton = solver.object("newton");
  step_ = std::make_unique<TimeStep>(
      problem_, *linear_,
      NewtonOptions{newton.number("tolerance"), newton.number("increment_tolerance"),
                    static_cast<int>(newton.integer("maximum_iterations")), newton.boolean("damping")},
      stepper_);
  ErrorList errors(communicator_);
  for (const auto& [name, parameters] : scene.root.object("output").map("probes"))
    errors.attempt([&, &called = name, &of = parameters] { probes_.emplace_back(called, of, problem_); });
  check_output(errors);
  errors.throw_if_any();
  timings_.setup = watch.seconds();
}

namespace {

/// A bound on the unknowns of a field, before there are any.
void require_allowed_unknowns(const Physics& physics, const MeshData& mesh, const Location& where) {
  if (physics.support() == Support::point) return;
  double unknowns = 0;
  for (const Unknown& unknown : physics.unknowns(mesh.dimension)) {
    // Halved edges: 2^dimension times as many nodes.
    const double nodes =
        mesh.node_count() * (unknown.order > mesh.order ? std::pow(2.0, mesh.dimension) : 1.0);
    unknowns += unknown.given ? 0 : nodes * unknown.components;
  }
  require_within(unknowns, policy().limits.unknowns, "unknowns", "unknowns of the field, about", where);
}

}  // namespace

void Simulation::build_fields(const Registry& registry) {
  meshes_ = load_meshes(scene_);
  check_mesh_names(scene_, registry, mesh_names(meshes_));
  ErrorList errors(communicator_);
  for (const auto& [name, parameters] : scene_.root.map("interfaces"))
    errors.attempt([&, &called = name, &of = parameters] {
      interfaces_.emplace_back(called, registry.create<Interface>("interface", of));
    });
  std::map<std::string, std::shared_ptr<const Mesh>> meshes;
  for (const auto& [name, parameters] : scene_.root.map("fields")) {
    const std::string& mesh = parameters.text("mesh");
    if (!meshes.contains(mesh))
      meshes[mesh] = needing_memory(
          fmt::format("the distributed mesh '{}' ({} cells)", mesh, meshes_.at(mesh)->cell_count()),
          parameters.where(),
          [&] { return std::make_shared<Mesh>(mesh, meshes_.at(mesh), communicator_, cell_costs(mesh)); });
    errors.attempt([&, &called = name, &of = parameters] {
      needing_memory(fmt::format("the unknowns of the field '{}'", called), of.where(),
                     [&] { add_field(called, of, meshes[mesh], registry); });
    });
  }
  errors.throw_if_any();
}

void Simulation::add_field(const std::string& name, const Parameters& parameters,
                           const std::shared_ptr<const Mesh>& mesh, const Registry& registry) {
  auto physics = registry.create<Physics>("field", parameters);
  const std::string plugin = plugin_of(*physics);
  call_plugin(
      parameters.where(), [&] { return fmt::format("field '{}'{}", name, plugin); },
      [&] {
        require_allowed_unknowns(*physics, mesh->whole(), parameters.where());
        problem_.add_field(name, mesh, std::move(physics), parameters.where());
      });
}

/// What the cells of a mesh cost, from the bodies that cut it at the start; empty where they all cost the
/// same.
std::vector<double> Simulation::cell_costs(const std::string& mesh) const {
  if (communicator_.size() == 1) return {};
  std::vector<const Interface*> cutting;
  for (const auto& [name, interface] : interfaces_)
    for (const auto& [field, parameters] : scene_.root.map("fields"))
      if (field == interface->fields().front() && parameters.text("mesh") == mesh)
        cutting.push_back(interface.get());
  if (cutting.empty()) return {};
  // Every rank holds the whole mesh at the start and finds the same costs.
  const Mesh whole(mesh, meshes_.at(mesh), Communicator(MPI_COMM_SELF));
  const MeshFinder find = [&](const std::string& name) { return meshes_.at(name); };
  std::vector<Surface> bodies;
  for (const Interface* interface : cutting)
    if (auto body = interface->body({whole, find}, stepper_.start())) bodies.push_back(std::move(*body));
  return bodies.empty() ? std::vector<double>{} : cut_cell_costs(whole, bodies);
}

/// What an interface may ask of the scene while it is built.
class Simulation::Setup final : public InterfaceSetup {
 public:
  Setup(Simulation& simulation, const std::vector<std::string>& names, int extra) : simulation_(simulation) {
    int order = 1;
    for (const std::string& name : names) {
      entries_.push_back(&simulation.problem_.field(name));
      sides.push_back(entries_.back()->field.get());
      order = std::max(order, sides.back()->order());
    }
    degree = 2 * order;
    extra_degree = extra;
  }
  FieldCut& cut(int side) override {
    if (!displacement(side).empty())
      throw Error(fmt::format(
          "field '{}' moves its mesh, so that no body can be cut out of it; only fields on fixed meshes can",
          entries_[side]->name));
    return simulation_.problem_.cut(*entries_[side]);
  }
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

namespace {

/// Of an entry of one of a scene's maps.
Location place_of(const Scene& scene, const std::string& map, const std::string& name) {
  for (const auto& [key, parameters] : scene.root.map(map))
    if (key == name) return parameters.where();
  return {};
}

bool speaks_of(const Coupling::SideTerm& term, int side) {
  return std::ranges::any_of(term.operands, [&](const Operand& operand) { return operand.side == side; });
}

/// The regions that a term of a coupling holds in, on the sides that it speaks of.
std::vector<BoundTerm::Region> regions_of(const Coupling::SideTerm& term, const CouplingSides& sides) {
  std::vector<BoundTerm::Region> result;
  for (int side = 0; side < static_cast<int>(sides.fields.size()); ++side)
    if (sides.fields[side]->regions() > 1 && speaks_of(term, side))
      result.push_back({side, sides.regions[side]});
  return result;
}

/// Of the terms that a coupling gives for each combination of regions, those that do not speak of a side
/// count once for all regions there.
bool concerns(const Coupling::SideTerm& term, const CouplingSides& sides) {
  for (int side = 0; side < static_cast<int>(sides.fields.size()); ++side)
    if (sides.regions[side] > 0 && !speaks_of(term, side)) return false;
  return true;
}

/// The next combination of regions of the sides. @return false after the last one
bool next_regions(CouplingSides& sides) {
  for (std::size_t side = 0; side < sides.fields.size(); ++side) {
    if (++sides.regions[side] < sides.fields[side]->regions()) return true;
    sides.regions[side] = 0;
  }
  return false;
}

}  // namespace

void Simulation::build_couplings(const Registry& registry) {
  struct Built {
    std::vector<InterfacePart> parts;
    std::vector<Field*> sides;
    /// @throws Error when there is no such part
    [[nodiscard]] const std::shared_ptr<IntegrationDomain>& part(const std::string& name) const {
      for (const InterfacePart& part : parts)
        if (part.name == name) return part.domain;
      std::vector<std::string> names;
      for (const InterfacePart& part : parts) names.push_back("'" + part.name + "'");
      throw Error(fmt::format("the coupling acts on the part '{}' of an interface whose parts are: {}", name,
                              fmt::join(names, ", ")));
    }
  };
  std::vector<std::pair<Parameters, std::unique_ptr<Coupling>>> couplings;
  const int dimension = static_cast<int>(scene_.root.integer("dimension"));
  std::map<std::string, int> extra_degree;  // by interface
  ErrorList errors(communicator_);
  for (const Parameters& parameters : scene_.root.list("coupling"))
    errors.attempt([&] {
      couplings.emplace_back(parameters, registry.create<Coupling>("coupling", parameters));
      int& most = extra_degree[parameters.text("on")];
      most = std::max(most, couplings.back().second->extra_degree(dimension));
    });
  std::map<std::string, Built> interfaces;
  const auto build = [&](const std::string& name, const Interface& interface) {
    Setup setup(*this, interface.fields(), extra_degree[name]);
    const Location where = place_of(scene_, "interfaces", name);
    auto parts = needing_memory(fmt::format("the interface '{}'", name), where, [&] {
      return call_plugin(
          where, [&] { return fmt::format("interface '{}'{}", name, plugin_of(interface)); },
          [&] { return interface.build(setup); });
    });
    interfaces[name] = {std::move(parts), setup.sides};
    problem_.name_interface(name, interfaces[name].parts);
  };
  for (const auto& [name, interface] : interfaces_)
    errors.attempt([&, &called = name, &of = interface] { build(called, *of); });
  errors.throw_if_any();
  std::vector<Coupling::Neighbour> neighbours;
  for (const auto& [parameters, coupling] : couplings)
    for (const auto& [name, interface] : interfaces_)
      if (name == parameters.text("on")) neighbours.push_back({parameters, interface->fields()});
  for (std::size_t k = 0; k < couplings.size(); ++k)
    errors.attempt([&] { couplings[k].second->check_beside(neighbours, k); });
  for (const auto& [parameters, coupling] : couplings) {
    const Built& built = interfaces.at(parameters.text("on"));
    const auto describe = [&, &of = parameters, &asked = coupling] {
      return fmt::format("coupling '{}' on '{}'{}", of.type(), of.text("on"), plugin_of(*asked));
    };
    const auto add = [&, &parameters = parameters, &coupling = coupling] {
      CouplingSides sides{{built.sides.begin(), built.sides.end()}, std::vector<int>(built.sides.size(), 0)};
      const auto bind = [&](const Coupling::SideTerm& term) {
        if (!term.term) throw PluginFault(parameters.where(), describe() + " gives a term that is null");
        BoundTerm bound{term.term, term.operands, {-1, -1}, regions_of(term, sides), parameters.where()};
        for (std::size_t k = 0; k < term.constants.size(); ++k) {
          const auto& [side, constant] = term.constants[k];
          bound.constants.at(k) = built.part(term.part)->add_constant(side, constant, sides.regions.at(side));
        }
        return bound;
      };
      std::map<std::string, std::vector<BoundTerm>> terms;  // by part
      std::vector<InterfaceMeasure> measures;
      do {
        for (const auto& term : coupling->terms(sides))
          if (concerns(term, sides)) terms[term.part].push_back(bind(term));
        std::size_t number = 0;
        for (const auto& measure : coupling->measures(sides)) {
          if (number == measures.size())
            measures.push_back({parameters.text("on"), measure.name, {}, measure.of});
          for (const auto& quantity : measure.quantities)
            if (concerns(quantity, sides))
              measures[number].shares.push_back({built.part(quantity.part), bind(quantity)});
          ++number;
        }
      } while (next_regions(sides));
      for (InterfaceMeasure& measure : measures) problem_.add_measure(std::move(measure));
      for (auto& [part, of_part] : terms) problem_.add_coupling(built.part(part), std::move(of_part));
    };
    errors.attempt([&, &of = parameters] { call_plugin(of.where(), describe, add); });
  }
  errors.throw_if_any();
}

/// The restart point to go on from, "" when the run starts afresh. Collective.
/// @throws Error when there are some, and all are damaged
std::filesystem::path Simulation::choose_restart() {
  std::string chosen;
  all_or_none(communicator_, [&] {
    if (!folder_->resumes()) return;
    std::vector<std::filesystem::path> points;
    for (const std::string& name : folder_->restart_points()) points.push_back(folder_->path() / name);
    std::vector<std::string> damaged;
    chosen = latest_restart(points, folder_->run(), damaged).string();
    if (chosen.empty() && !points.empty())
      throw Error(fmt::format("no restart point can be used:\n  {}\nTo begin anew, say --overwrite",
                              fmt::join(damaged, "\n  ")));
    for (const std::string& warning : damaged)
      fmt::print(stderr, "warning: {}; an older one is used\n", warning);
  });
  return from_root(communicator_, chosen);
}

void Simulation::announce_start(bool resumed) const {
  if (communicator_.rank() != 0) return;
  if (resumed)
    fmt::print(stderr, "continues from t = {:.6g}, step {}\n", state_.time, state_.step_number);
  else
    fmt::print(stderr, "no restart point: starts at t = {:.6g}\n", state_.time);
}

void Simulation::prepare() {
  state_.time = stepper_.start();
  state_.step = stepper_.initial();
  problem_.initialise(stepper_.start(), !stepper_.is_static());
  const TimePoint at = time_point(stepper_.start(), 0, stepper_.theta());
  problem_.update_spaces(at);
  step_->start();
  problem_.assembler().assemble(at, false);
  append_row(at);
  measure_errors();
}

namespace {

/// Of this process: beside others it is what the work takes, not the clock.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

void Simulation::require_held() {
  const double step = stepper_.is_static() ? 0 : stepper_.initial();
  const double before = processor_seconds();
  problem_.assembler().assemble(time_point(stepper_.start(), step, stepper_.theta()), true);
  assembly_seconds_ = processor_seconds() - before;
  const std::string free = describe_free_modes(problem_, no_resistance);
  if (!free.empty()) throw Error(scene_.root.where("fields"), free);
  problem_.check_levels();
}

void Simulation::check_output(ErrorList& errors) {
  const Parameters& output = scene_.root.object("output");
  errors.attempt([&] {
    if (output.boolean("interfaces") &&
        std::ranges::all_of(problem_.measures(), [](const InterfaceMeasure& m) { return m.shares.empty(); }))
      throw Error(
          output.where("interfaces"),
          "interfaces: no coupling measures anything on its interface, so that there is nothing to write");
  });
  errors.attempt([&] {
    if (output.boolean("cut") &&
        std::ranges::none_of(problem_.fields(), [](const FieldEntry& entry) { return entry.cut != nullptr; }))
      throw Error(output.where("cut"),
                  "cut: no interface cuts a body out of a field, so that there is no cut to write");
  });
  if (!output.has("picture")) return;
  const Parameters& picture = output.object("picture");
  errors.attempt([&] {
    try {
      static_cast<void>(find_quantity(problem_.field(picture.text("field")), picture.text("quantity")));
    } catch (const Error& error) {
      throw Error(picture.where("quantity"), error.what());
    }
  });
}

void Simulation::start(const RunOptions& options) {
  if (!options.results)
    own_folder_ = std::make_unique<ResultsFolder>(
        communicator_, scene_, options.folder,
        FolderUse{.resume = options.resume, .changed = false, .overwrite = !options.resume});
  folder_ = options.results ? options.results : own_folder_.get();
  const std::filesystem::path point = choose_restart();
  const bool resumed = !point.empty();
  if (resumed) {
    state_ = read_restart(point, problem_);
    step_->set_largest(state_.largest);
    problem_.update_spaces(time_point(state_.time, 0, stepper_.theta()));
  } else {
    // What is wrong with it is said before anything of an earlier run is replaced.
    prepare();
  }
  find_conflicts();
  if (communicator_.rank() == 0 && !options.quiet && !warnings_.all().empty())
    fmt::print(stderr, "{}\n", warnings_.text());
  if (options.resume && options.announce) announce_start(resumed);
  folder_->begin(resumed ? std::optional(state_.step_number) : std::nullopt);
  open_outputs(resumed ? state_.time : -1.0);
  const TimePoint at = time_point(state_.time, 0, stepper_.theta());
  if (resumed) {
    last_point_ = at;
    last_restart_ = state_.step_number;
  } else {
    write_outputs(at);
  }
  all_or_none<FileError>(communicator_, [&] {
    if (communicator_.rank() != 0) return;
    series_.emplace(*folder_).append(state_.results);
    events_.emplace(*folder_).open(state_.step_number);
  });
}

void Simulation::find_conflicts() {
  const std::vector<Diagnostic> at_start = problem_.find_conflicts(stepper_.start());
  std::vector<Diagnostic> conflicts = at_start;
  for (Diagnostic& later : problem_.find_conflicts(stepper_.end()))
    if (std::ranges::none_of(at_start,
                             [&](const Diagnostic& d) { return d.where.text() == later.where.text(); }))
      conflicts.push_back(std::move(later));
  for (Diagnostic& conflict : conflicts)
    warnings_.warning(std::move(conflict.where), std::move(conflict.message));
  const MeshFinder find = [&](const std::string& name) { return meshes_.at(name); };
  for (Diagnostic& doubt :
       scene_doubts({scene_, problem_, interfaces_, find, state_.results, stepper_.start(), stepper_.end()}))
    warnings_.warning(std::move(doubt.where), std::move(doubt.message));
}

void Simulation::open_outputs(double resume_time) {
  const Parameters& output = scene_.root.object("output");
  if (output.boolean("fields")) fields_ = std::make_unique<FieldOutput>(problem_, *folder_, resume_time);
  if (output.boolean("interfaces")) points_ = std::make_unique<InterfaceOutput>(problem_, *folder_);
  if (output.boolean("cut")) cut_ = std::make_unique<CutOutput>(problem_, *folder_, resume_time);
}

const Results& Simulation::run(const RunOptions& options) {
  run_watch_ = restart_watch_ = Stopwatch();
  start(options);
  double step = state_.step;
  long taken = 0;
  while (!stepper_.finished(state_.time)) {
    if (options.stop_after && taken++ == *options.stop_after) break;
    if (!attend(options)) break;
    const double from = state_.time, until = stepper_.target(from, step);
    const bool is_taken = needing_memory(
        fmt::format("the step from t = {:.6g} to {:.6g}, with {} unknowns", from, until, unknowns()), {},
        [&] { return try_step(until); });
    if (is_taken) {
      step = stepper_.after_success(until, step, until - from, step_->error(), reports_.back().iterations());
      state_.step = step;
      note_step(until - from);
      if (restart_due()) save_restart();
      show_progress(options, run_watch_.seconds());
      continue;
    }
    ++state_.rejected_steps;
    if (events_) events_->refuse(until - from, reports_.back());
    const std::optional<double> shorter = stepper_.after_failure(until - from);
    if (!shorter)
      throw Error(fmt::format("the step from t = {:.6g} fails down to a length of {:.2g}: {}", from,
                              until - from, reports_.back().reason));
    step = *shorter;
  }
  if (stepper_.finished(state_.time)) finish_results();
  if (interruption_ || !stepper_.finished(state_.time)) keep_state();
  finish_timings();
  note_end();
  if (own_folder_) {
    own_folder_->finish(status());
    own_folder_.reset();
    folder_ = nullptr;
  }
  return state_.results;
}

/// What came from outside since the last step. Collective. @returns whether to go on
bool Simulation::attend(const RunOptions& options) {
  const double minutes = scene_.root.object("output").object("restart").number("minutes");
  Attention mine;
  mine.signal = SignalWatch::caught();
  if (communicator_.rank() == 0) {  // whose clock counts
    mine.out_of_time = timings_.setup + run_watch_.seconds() > options.time_limit;
    mine.restart_due = minutes > 0 && restart_watch_.seconds() > 60 * minutes;
  }
  const Attention all = agree(communicator_, mine);
  if (all.signal != 0)
    interruption_ = {all.signal, fmt::format("{} was caught", signal_name(all.signal))};
  else if (all.out_of_time)
    interruption_ = {0, fmt::format("the time limit of {:.6g} s is over", options.time_limit)};
  else if (all.restart_due && last_restart_ != state_.step_number)
    save_restart();
  return !interruption_;
}

/// A step was taken: its row and its line. Collective.
void Simulation::note_step(double length) {
  all_or_none<FileError>(communicator_, [&] {
    if (communicator_.rank() != 0) return;
    series_->append(state_.results);
    events_->take(state_.step_number, state_.time, length, reports_.back(), run_watch_.seconds());
  });
}

void Simulation::note_end() {
  all_or_none<FileError>(communicator_, [&] {
    if (events_)
      events_->end(state_.step_number, state_.time, status(),
                   interruption_ ? interruption_->reason : failure_, run_watch_.seconds());
  });
}

/// Puts the last good state on disk. Collective.
void Simulation::keep_state() {
  if (last_restart_ != state_.step_number) save_restart();
  if (last_fields_ != state_.step_number) write_fields(last_point_);
}

std::string Simulation::status() const {
  if (!failure_.empty()) return "failed";
  if (interruption_) return "interrupted";
  return stepper_.finished(state_.time) ? "finished" : "stopped";
}

void Simulation::finish_timings() {
  timings_.cut = problem_.cut_seconds();
  timings_.pattern = problem_.assembler().pattern_seconds();
  timings_.assembly = problem_.assembler().assembly_seconds();
  timings_.total = run_watch_.seconds() + timings_.setup;
}

void Simulation::record_failure(const std::string& reason) {
  failure_ = reason;
  finish_timings();
  if (state_.results.time.empty()) return;  // it failed before there was a state
  problem_.update_spaces(last_point_);
  keep_state();
  note_end();
}

double Simulation::last_step() const {
  const std::vector<double>& times = state_.results.time;
  return times.size() > 1 ? times.back() - times[times.size() - 2] : 0;
}

/// One step to the time `until`; leaves everything as it was when it fails.
bool Simulation::try_step(double until) {
  const auto keep_report = [&](const std::string& reason) {
    reports_.push_back(step_->report());
    timings_.linear += reports_.back().linear_seconds;
    if (reason.empty()) return;
    reports_.back().converged = false;
    reports_.back().reason = reason;
  };
  try {
    step_->begin(state_.time, until, last_step());
    while (step_->iterate()) continue;
    keep_report(step_->report().reason);
  } catch (const StepRefused& refused) {
    keep_report(refused.what());
  } catch (const SingularMatrix& singular) {
    keep_report(singular.what());
    step_->rewind();
    // What has been held so far is lost on a state that iterations went astray to, as where a body snaps
    // through.
    if (state_.step_number > 0) return false;
    throw;
  } catch (...) {
    step_->rewind();
    throw;
  }
  if (reports_.back().converged && stepper_.too_inaccurate(step_->error(), until - state_.time)) {
    reports_.back().converged = false;
    reports_.back().reason = fmt::format("its error in time is {:.1e}", step_->error());
  }
  if (!reports_.back().converged) {
    step_->rewind();
    return false;
  }
  try {
    append_row(step_->at());
  } catch (...) {
    step_->rewind();
    throw;
  }
  step_->accept();
  state_.time = until;
  ++state_.step_number;
  state_.iterations.push_back(reports_.back().iterations());
  state_.largest = step_->largest();
  write_outputs(step_->at());
  return true;
}

/// All numbers of a state, or none: what is recorded is a table.
void Simulation::append_row(const TimePoint& at) {
  const Stopwatch watch;
  Results row;
  row.time.push_back(at.time);
  for (const Probe& probe : probes_) probe.record(problem_, at, row);
  record_integrals(problem_, at, row);
  if (!names_checked_) check_result_names(scene_, row);
  names_checked_ = true;
  check_numbers(row);
  record_formulas(scene_, row);
  state_.results.append(row);
  timings_.output += watch.seconds();
}

void Simulation::write_outputs(const TimePoint& at) {
  const Stopwatch watch;
  const long every = scene_.root.object("output").integer("every");
  const bool last = state_.time >= stepper_.end();
  last_point_ = at;
  if (state_.step_number % every == 0 || last) write_fields(at);
  timings_.output += watch.seconds();
}

void Simulation::write_fields(const TimePoint& at) {
  if (fields_) fields_->write(state_.step_number, at);
  if (cut_) cut_->write(state_.step_number, at);
  if (points_) points_->write(state_.step_number, at);
  last_fields_ = state_.step_number;
}

bool Simulation::restart_due() const {
  const long every = scene_.root.object("output").object("restart").integer("every");
  return every != 0 && state_.step_number % every == 0;
}

void Simulation::save_restart() {
  const Stopwatch watch;
  const std::string name = fmt::format("restart/{:08}.restart", state_.step_number);
  all_or_none<FileError>(communicator_, [&] { folder_->claim(name, state_.step_number); });
  write_restart(folder_->path() / name, problem_, state_, folder_->run());
  all_or_none<FileError>(communicator_, [&] {
    const std::vector<std::string> points = folder_->restart_points();
    const auto keep =
        static_cast<std::size_t>(scene_.root.object("output").object("restart").integer("keep"));
    for (std::size_t k = keep; k < points.size(); ++k) folder_->remove(points[k]);
  });
  last_restart_ = state_.step_number;
  restart_watch_ = Stopwatch();
  timings_.output += watch.seconds();
}

std::map<std::string, double> Simulation::measure_errors() {
  std::map<std::string, double> errors;
  for (const auto& [name, p] : scene_.root.object("output").map("errors")) {
    const FieldEntry& entry = problem_.field(p.text("field"));
    const auto& exact = p.vector_expression("exact");
    const auto gradient = p.has("gradient") ? p.vector_expression("gradient") : std::vector<Expression>{};
    require_known_solution(entry, p);
    const ErrorNorms norms = p.has("interface")
                                 ? interface_error_norms(problem_.interfaces().at(p.text("interface")), entry,
                                                         p.text("unknown"), exact, gradient, state_.time)
                                 : error_norms(entry, p.text("unknown"), exact, gradient, state_.time);
    errors[name + ".l2"] = norms.l2;
    if (norms.h1) errors[name + ".h1"] = *norms.h1;
  }
  return errors;
}

void Simulation::finish_results() {
  for (const auto& [name, error] : measure_errors()) state_.results.once[name] = error;
  finish_statistics(scene_, state_.results);
  int most_linear = 0, frozen = 0;
  for (const NewtonReport& report : reports_) {
    if (report.frozen && report.converged) ++frozen;
    for (const NewtonIteration& iteration : report.history)
      most_linear = std::max(most_linear, iteration.linear_iterations);
  }
  std::vector<int> iterations = state_.iterations;
  std::sort(iterations.begin(), iterations.end());
  state_.results.once["newton.iterations.median"] =
      iterations.empty() ? 0 : iterations[iterations.size() / 2];
  state_.results.once["newton.iterations.most"] = iterations.empty() ? 0 : iterations.back();
  state_.results.once["steps.taken"] = static_cast<double>(state_.iterations.size());
  state_.results.once["steps.rejected"] = static_cast<double>(state_.rejected_steps);
  state_.results.once["newton.frozen_steps"] = frozen;
  state_.results.once["linear.iterations.most"] = most_linear;
  state_.results.once["unknowns"] = static_cast<double>(unknowns());
}

long long Simulation::unknowns() { return problem_.assembler().matrix().global_rows; }

void Simulation::show_progress(const RunOptions& options, double seconds) const {
  if (options.quiet || communicator_.rank() != 0) return;
  const double done = (state_.time - stepper_.start()) / (stepper_.end() - stepper_.start());
  print_progress({state_.step_number, state_.time, reports_.back().iterations(), done, seconds});
}

}  // namespace seam
