// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/recorders.hpp"

#include <fmt/format.h>

#include "seam/base/all_or_none.hpp"
#include "seam/record/cut_output.hpp"
#include "seam/record/field_output.hpp"
#include "seam/record/interface_output.hpp"
#include "seam/record/live_files.hpp"
#include "seam/record/progress.hpp"

namespace seam {

PictureRecorder::PictureRecorder(const Scene& scene, Problem& problem, ResultsFolder& folder,
                                 double resume_time) {
  const Parameters& output = scene.root.object("output");
  every_ = output.integer("every");
  if (output.boolean("fields")) fields_ = std::make_unique<FieldOutput>(problem, folder, resume_time);
  if (output.boolean("interfaces")) points_ = std::make_unique<InterfaceOutput>(problem, folder);
  if (output.boolean("cut")) cut_ = std::make_unique<CutOutput>(problem, folder, resume_time);
}

PictureRecorder::~PictureRecorder() = default;

void PictureRecorder::begin(const Standing& now, bool resumed) {
  if (!resumed) write(now);
}

void PictureRecorder::take(const Standing& now, const Attempt& /*last*/) {
  if (now.state.step_number % every_ == 0 || now.part >= 1) write(now);
}

void PictureRecorder::keep(const Standing& now) {
  if (last_ != now.state.step_number) write(now);
}

void PictureRecorder::write(const Standing& now) {
  last_ = now.state.step_number;
  if (fields_) fields_->write(last_, now.at);
  if (cut_) cut_->write(last_, now.at);
  if (points_) points_->write(last_, now.at);
}

LogRecorder::LogRecorder(const Communicator& communicator, ResultsFolder& folder)
    : communicator_(communicator) {
  if (communicator.rank() != 0) return;
  series_ = std::make_unique<SeriesFile>(folder);
  events_ = std::make_unique<EventFile>(folder);
}

LogRecorder::~LogRecorder() = default;

void LogRecorder::begin(const Standing& now, bool /*resumed*/) {
  all_or_none<FileError>(communicator_, [&] {
    if (!series_) return;
    series_->append(now.state.results);
    events_->open(now.state.step_number);
  });
}

void LogRecorder::take(const Standing& now, const Attempt& last) {
  all_or_none<FileError>(communicator_, [&] {
    if (!series_) return;
    series_->append(now.state.results);
    events_->take(now.state.step_number, now.state.time, last.length, last.report, now.seconds);
  });
}

void LogRecorder::refuse(const Standing& /*now*/, const Attempt& last) {
  if (events_) events_->refuse(last.length, last.report);
}

void LogRecorder::end(const Standing& now, const std::string& status, const std::string& reason) {
  all_or_none<FileError>(communicator_, [&] {
    if (events_) events_->end(now.state.step_number, now.state.time, status, reason, now.seconds);
  });
}

RestartRecorder::RestartRecorder(const Scene& scene, const Problem& problem, ResultsFolder& folder)
    : problem_(problem), folder_(folder) {
  const Parameters& restart = scene.root.object("output").object("restart");
  minutes_ = restart.number("minutes");
  every_ = restart.integer("every");
  most_ = static_cast<std::size_t>(restart.integer("keep"));
}

void RestartRecorder::take(const Standing& now, const Attempt& /*last*/) {
  if (every_ != 0 && now.state.step_number % every_ == 0) keep(now);
}

void RestartRecorder::keep(const Standing& now) {
  if (last_ == now.state.step_number) return;
  const Communicator& communicator = problem_.communicator();
  const std::string name = fmt::format("restart/{:08}.restart", now.state.step_number);
  all_or_none<FileError>(communicator, [&] { folder_.claim(name, now.state.step_number); });
  write_restart(folder_.path() / name, problem_, now.state, folder_.run());
  all_or_none<FileError>(communicator, [&] {
    const std::vector<std::string> points = folder_.restart_points();
    for (std::size_t k = most_; k < points.size(); ++k) folder_.remove(points[k]);
  });
  last_ = now.state.step_number;
  watch_ = Stopwatch();
}

void ProgressRecorder::take(const Standing& now, const Attempt& last) {
  print_progress({now.state.step_number, now.state.time, last.report.iterations(), last.report.shares,
                  now.part, now.seconds});
}

}  // namespace seam
