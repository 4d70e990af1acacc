// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "seam/run/time_use.hpp"

namespace seam {
namespace {

/// The first column of a series.csv.
std::vector<double> read_times(const std::string& file, const Location& where) {
  std::ifstream in(file);
  std::string line;
  if (!in || !std::getline(in, line) || !line.starts_with("time"))
    throw Error(where,
                fmt::format("'{}' holds no series of an earlier run; expected the series.csv of one", file));
  std::vector<double> times;
  for (int number = 2; std::getline(in, line); ++number) {
    const std::string word = line.substr(0, line.find(','));
    const auto bad = [&](const std::string& expected) {
      return Error(
          where, fmt::format("line {} of '{}' begins with '{}'; expected {}", number, file, word, expected));
    };
    double time = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), time);
    if (code != std::errc{} || end != word.data() + word.size() || !std::isfinite(time))
      throw bad("a time, as at the beginning of each line of a series.csv");
    if (!times.empty() && time <= times.back())
      throw bad(fmt::format("a time after that of the line before, {}", times.back()));
    times.push_back(time);
  }
  if (times.size() < 2)
    throw Error(where, fmt::format("'{}' holds {} times, so that there is no step in it to take again", file,
                                   times.size()));
  return times;
}

}  // namespace

Stepper::Stepper(const Scene& scene) {
  if (!scene.root.has("time")) return;
  const Parameters& p = scene.root.object("time");
  static_ = p.boolean("static");
  theta_ = p.number("theta");
  two_steps_ = p.text("scheme") == "bdf2";
  if (two_steps_ && theta_ != 1)
    throw Error(p.where("theta"), "BDF2 has no theta; leave it out, or take `scheme: one_step_theta`");
  start_ = p.number("start");
  end_ = p.number("end");
  if (end_ <= start_)
    throw Error(p.where("end"), fmt::format("the end {} does not come after the start {}", end_, start_));
  initial_ = maximum_ = end_ - start_;
  minimum_ = 1e-6 * initial_;
  const TimeUse use = find_time_use(scene, start_, end_);
  depends_on_time_ = use.any;
  kinks_.clear();
  for (const double kink : use.kinks)
    if (kink > start_ && kink < end_) kinks_.push_back(kink);
  kinks_.push_back(end_);
  if (p.has("step")) read_steps(p.object("step"));
}

void Stepper::read_steps(const Parameters& step) {
  initial_ = maximum_ = std::min(step.number("initial"), end_ - start_);
  minimum_ = 1e-6 * initial_;
  adaptive_ = step.boolean("adaptive");
  tolerance_ = step.number("tolerance");
  if (adaptive_) maximum_ = std::max(initial_, 0.1 * (end_ - start_));
  if (step.has("maximum")) maximum_ = step.number("maximum");
  if (step.has("minimum")) minimum_ = step.number("minimum");
  if (step.has("replay")) replay_ = read_times(step.text("replay"), step.where("replay"));
}

double Stepper::target(double time, double planned) const {
  const double until = aim(time, planned);
  if (until > time) return until;
  // Else the run would go on for ever at the same time.
  throw Error(
      fmt::format("a step of {:.3g} s from t = {:.17g} does not advance the clock: numbers of that size "
                  "are {:.2g} apart; take longer steps, or let the time start nearer to 0",
                  planned, time, std::nextafter(time, HUGE_VAL) - time));
}

double Stepper::aim(double time, double planned) const {
  const double slack = 1e-10 * (end_ - start_);
  const auto next = std::upper_bound(replay_.begin(), replay_.end(), time + slack);
  if (next != replay_.end()) return std::min(*next, time + planned);
  if (!adaptive_) planned = std::min(planned, to_grid(time));
  const double stop = *std::upper_bound(kinks_.begin(), kinks_.end() - 1, time + slack);
  // No crumbs: a step up to a hundredth longer or shorter than planned swallows them.
  return stop - time < 1.01 * planned ? stop : time + planned;
}

/// From a time to the next one of the given grid: there a run with fixed steps returns after a failed step or
/// a kink.
double Stepper::to_grid(double time) const {
  const double done = (time - start_) / initial_;
  const double rest = (std::floor(done + 1 + 1e-9) - done) * initial_;
  return rest < 0.01 * initial_ ? rest + initial_ : rest;
}

double Stepper::after_success(double time, double planned, double taken, double error, int iterations) const {
  if (!replay_.empty()) return end_ - start_;
  if (!adaptive_) return std::min(2 * planned, initial_);
  const bool at_kink = std::binary_search(kinks_.begin(), kinks_.end(), time);
  if (at_kink) return std::min(initial_, std::max(planned, taken));
  constexpr double most = 1.5;
  constexpr int many = 8;
  double factor = most;
  if (error > 0) factor = std::clamp(0.9 * std::sqrt(tolerance_ / error), 0.3, most);
  // A step that took many iterations should not be followed by a longer one.
  if (iterations > many) factor = std::min(factor, 0.7);
  return std::clamp(factor * taken, minimum_, maximum_);
}

std::optional<double> Stepper::after_failure(double taken) const {
  const double shorter = taken / 2;
  // Without rates and without loads that grow, half a step is the same problem again.
  if (shorter < minimum_ || (static_ && !depends_on_time_)) return std::nullopt;
  return shorter;
}

bool Stepper::too_inaccurate(double error, double taken) const {
  // Not below the first step: what starts from rest has the same relative error with any step.
  return adaptive_ && error > 10 * tolerance_ && taken > 1.01 * initial_;
}

}  // namespace seam
