// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/simulation.hpp"

#include <fmt/ranges.h>

#include "seam/assembly/assembler.hpp"
#include "seam/base/all_or_none.hpp"
#include "seam/base/memory.hpp"
#include "seam/run/interruption.hpp"
#include "seam/scene/resolved.hpp"

namespace seam {

Simulation::Simulation(const Scene& scene, const Registry& registry, const Communicator& communicator)
    : scene_(scene),
      communicator_(communicator),
      // It reads the files that the scene names: once, by the rank that writes the summary.
      resolved_checksum_(communicator.rank() == 0 ? resolved_checksum(resolve(scene, registry)) : ""),
      session_(scene, registry, communicator) {}

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
  const RunState& state = session_.state();
  if (resumed)
    fmt::print(stderr, "continues from t = {:.6g}, step {}\n", state.time, state.step_number);
  else
    fmt::print(stderr, "no restart point: starts at t = {:.6g}\n", state.time);
}

Standing Simulation::standing() const {
  const Stepper& stepper = session_.stepper();
  const double part = (session_.state().time - stepper.start()) / (stepper.end() - stepper.start());
  return {session_.state(), session_.at(), part, run_watch_.seconds()};
}

template <class Call>
void Simulation::tell(Call&& call) {
  const Stopwatch watch;
  for (const auto& recorder : recorders_) call(*recorder);
  recording_seconds_ += watch.seconds();
}

void Simulation::add_recorders(const RunOptions& options, double resume_time) {
  // Pictures first: a restart point says that all before it is on disk.
  recorders_.push_back(std::make_unique<PictureRecorder>(scene_, session_.problem(), *folder_, resume_time));
  recorders_.push_back(std::make_unique<LogRecorder>(communicator_, *folder_));
  auto restart = std::make_unique<RestartRecorder>(scene_, session_.problem(), *folder_);
  restart_ = restart.get();
  recorders_.push_back(std::move(restart));
  if (!options.quiet && communicator_.rank() == 0) recorders_.push_back(std::make_unique<ProgressRecorder>());
}

void Simulation::start(const RunOptions& options) {
  if (!options.results)
    own_folder_ = std::make_unique<ResultsFolder>(
        communicator_, scene_, options.folder,
        FolderUse{.resume = options.resume, .changed = false, .overwrite = !options.resume});
  folder_ = options.results ? options.results : own_folder_.get();
  const std::filesystem::path point = choose_restart();
  const bool resumed = !point.empty();
  if (resumed)
    session_.continue_from(point);
  else
    session_.prepare();  // what is wrong with it is said before anything of an earlier run is replaced
  session_.find_conflicts();
  const Diagnostics& warnings = session_.warnings();
  if (communicator_.rank() == 0 && !options.quiet && !warnings.all().empty())
    fmt::print(stderr, "{}\n", warnings.text());
  if (options.resume && options.announce) announce_start(resumed);
  const RunState& state = session_.state();
  folder_->begin(resumed ? std::optional(state.step_number) : std::nullopt);
  add_recorders(options, resumed ? state.time : -1.0);
  tell([&](Recorder& recorder) { recorder.begin(standing(), resumed); });
}

const Results& Simulation::run(const RunOptions& options) {
  run_watch_ = Stopwatch();
  start(options);
  const RunState& state = session_.state();
  const long first = state.step_number;
  double step = state.step;
  // A run that is resumed takes refused steps again: only where one was taken they become part of the state.
  Refusals refusals = state.refusals;
  while (!session_.finished()) {
    if (options.stop_after && state.step_number - first >= *options.stop_after) break;
    if (options.stop_at && state.time >= *options.stop_at) break;
    if (!attend(options)) break;
    step = advance(step, refusals);
  }
  if (session_.finished()) session_.finish_results();
  if (interruption_ || !session_.finished()) tell([&](Recorder& recorder) { recorder.keep(standing()); });
  end();
  if (own_folder_) {
    own_folder_->finish(status());
    recorders_.clear();  // they write to it
    restart_ = nullptr;
    own_folder_.reset();
    folder_ = nullptr;
  }
  return session_.results();
}

/// Tries a step. @param step its length, s, unless something comes first @param refusals so far
/// @return the length to try next, s
double Simulation::advance(double step, Refusals& refusals) {
  const Stepper& stepper = session_.stepper();
  const double from = session_.state().time, until = stepper.target(from, step), length = until - from;
  const bool is_taken = needing_memory(
      fmt::format("the step from t = {:.6g} to {:.6g}, with {} unknowns", from, until, session_.unknowns()),
      {}, [&] { return session_.step(until); });
  const Attempt attempt{length, session_.reports().back()};
  if (is_taken) {
    const double next = refusals.accept(
        step, length,
        stepper.after_success(until, step, length, session_.time_error(), attempt.report.iterations()));
    session_.plan(next, refusals);
    tell([&](Recorder& recorder) { recorder.take(standing(), attempt); });
    return next;
  }
  refusals.refuse(length);
  tell([&](Recorder& recorder) { recorder.refuse(standing(), attempt); });
  const std::optional<double> shorter = stepper.after_failure(length);
  if (!shorter)
    throw Error(fmt::format("the step from t = {:.6g} fails down to a length of {:.2g}: {}", from, length,
                            attempt.report.reason));
  return *shorter;
}

/// What came from outside since the last step. Collective. @returns whether to go on
bool Simulation::attend(const RunOptions& options) {
  Attention mine;
  mine.signal = SignalWatch::caught();
  if (communicator_.rank() == 0) {  // whose clock counts
    mine.out_of_time = session_.setup_seconds() + run_watch_.seconds() > options.time_limit;
    mine.restart_due = restart_->due_by_clock();
  }
  const Attention all = agree(communicator_, mine);
  if (all.signal != 0)
    interruption_ = {all.signal, fmt::format("{} was caught", signal_name(all.signal))};
  else if (all.out_of_time)
    interruption_ = {0, fmt::format("the time limit of {:.6g} s is over", options.time_limit)};
  else if (all.restart_due)
    restart_->keep(standing());
  return !interruption_;
}

/// Ends the record of a run that failed or came to its end.
void Simulation::end() {
  finish_timings();
  const std::string reason = interruption_ ? interruption_->reason : failure_;
  tell([&](Recorder& recorder) { recorder.end(standing(), status(), reason); });
}

std::string Simulation::status() const {
  if (!failure_.empty()) return "failed";
  if (interruption_) return "interrupted";
  return session_.finished() ? "finished" : "stopped";
}

void Simulation::finish_timings() {
  Problem& problem = session_.problem();
  timings_.setup = session_.setup_seconds();
  timings_.cut = problem.cut_seconds();
  timings_.pattern = problem.assembler().pattern_seconds();
  timings_.assembly = problem.assembler().assembly_seconds();
  timings_.linear = session_.linear_seconds();
  timings_.output = recording_seconds_ + session_.observing_seconds();
  timings_.total = run_watch_.seconds() + timings_.setup;
}

void Simulation::record_failure(const std::string& reason) {
  failure_ = reason;
  finish_timings();
  if (!has_state()) return;  // it failed before there was a state
  session_.problem().update_spaces(session_.at());
  tell([&](Recorder& recorder) { recorder.keep(standing()); });
  end();
}

}  // namespace seam
