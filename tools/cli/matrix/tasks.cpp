// SPDX-License-Identifier: BSD-3-Clause
#include "tasks.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <list>
#include <memory>
#include <numeric>
#include <string>

#include "seam/base/program.hpp"
#include "seam/base/stopwatch.hpp"
#include "seam/run/interruption.hpp"

namespace seam::cli {
namespace {

/// How long a program that was asked to end may take for it, s.
constexpr double grace = 5;

/// A task that has been begun.
class RunningTask {
 public:
  RunningTask(const Task& task, std::size_t number) : task_(task), number_(number) { begin(); }

  /// Goes on to the next program where one has ended. @returns whether the task has ended
  bool attend(double seconds_each) {
    const std::optional<int> code = program_->ended();
    if (!code) {
      if (asked_ < 0 && watch_.seconds() > seconds_each) {
        end_.out_of_time = true;
        ask_to_end();
      }
      if (asked_ >= 0 && watch_.seconds() - asked_ > grace) program_->send(SIGKILL);
      return false;
    }
    end_.code = *code;
    end_.seconds = watch_.seconds();
    if (*code != 0 || asked_ >= 0 || end_.last + 1 == task_.steps.size()) return true;
    ++end_.last;
    begin();
    return false;
  }

  void ask_to_end() {
    asked_ = watch_.seconds();
    program_->send(SIGTERM);
  }

  [[nodiscard]] const Task& task() const { return task_; }
  [[nodiscard]] std::size_t number() const { return number_; }
  [[nodiscard]] const TaskEnd& end() const { return end_; }

 private:
  void begin() {
    const Task::Step& step = task_.steps[end_.last];
    program_ = std::make_unique<RunningProgram>(step.command, step.output);
  }

  const Task& task_;
  std::size_t number_;
  TaskEnd end_;
  Stopwatch watch_;
  double asked_ = -1;  ///< when it was asked to end, s
  std::unique_ptr<RunningProgram> program_;
};

double free_bytes() {
  std::ifstream in("/proc/meminfo");
  std::string key, rest;
  for (double kibibytes = 0; in >> key >> kibibytes; std::getline(in, rest))
    if (key == "MemAvailable:") return 1024 * kibibytes;
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

int own_cores() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? std::max(1, CPU_COUNT(&set)) : 1;
}

}  // namespace

Machine this_machine() {
  // Estimates of memory are good to some tens of per cent.
  constexpr double part = 0.8;
  return {own_cores(), part * free_bytes(), 0};
}

int run_tasks(const std::vector<Task>& tasks, const Machine& machine,
              const std::function<void(std::size_t task, const TaskEnd& end)>& ended) {
  std::list<std::size_t> waiting(tasks.size());
  std::iota(waiting.begin(), waiting.end(), 0);
  waiting.sort(
      [&](std::size_t a, std::size_t b) { return tasks[a].seconds > tasks[b].seconds; });  // is stable
  std::list<RunningTask> running;
  const auto fits = [&](const Task& task) {
    int cores = task.cores;
    double bytes = task.bytes;
    for (const RunningTask& other : running) {
      cores += other.task().cores;
      bytes += other.task().bytes;
    }
    return running.empty() || (cores <= machine.cores && bytes <= machine.bytes);
  };
  const auto begin_what_fits = [&] {
    for (auto next = waiting.begin(); next != waiting.end();) {
      const bool begins = fits(tasks[*next]);
      if (begins) running.emplace_back(tasks[*next], *next);
      next = begins ? waiting.erase(next) : std::next(next);
    }
  };
  int signal = 0;
  while (true) {
    if (signal == 0) begin_what_fits();
    if (running.empty()) return signal;
    for (auto task = running.begin(); task != running.end();) {
      const bool is_over = task->attend(machine.seconds_each);
      if (is_over && signal == 0) ended(task->number(), task->end());
      task = is_over ? running.erase(task) : std::next(task);
    }
    if (signal == 0 && (signal = SignalWatch::caught()) != 0)
      for (RunningTask& task : running) task.ask_to_end();
    constexpr useconds_t pause = 5000;
    usleep(pause);
  }
}

}  // namespace seam::cli
