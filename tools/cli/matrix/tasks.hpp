// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace seam::cli {

/// Programs that run one after the other, the next one only where the one before ends with exit code 0.
struct Task {
  struct Step {
    std::vector<std::string> command;
    std::filesystem::path output;
  };
  std::vector<Step> steps;
  int cores = 1;
  double bytes = 0;    ///< of memory, about
  double seconds = 0;  ///< about how long it takes: those that take longest are begun first
};

/// How it ended.
struct TaskEnd {
  int code = 0;              ///< of its last program
  std::size_t last = 0;      ///< that program's number
  bool out_of_time = false;  ///< it was ended for taking too long
  double seconds = 0;        ///< by the clock
};

/// What all tasks share.
struct Machine {
  int cores = 1;
  double bytes = 0;
  double seconds_each = 0;  ///< that a task may take
};

/// The memory that is free now; the cores that this process may use.
Machine this_machine();

/// Runs tasks, as many at once as cores and memory allow; one that needs more than there is runs alone. To be
/// called while a SignalWatch lives: a signal ends those that run, and no other is begun.
/// @param ended called as they end, with the task's number
/// @returns the signal that was caught, or 0
int run_tasks(const std::vector<Task>& tasks, const Machine& machine,
              const std::function<void(std::size_t task, const TaskEnd& end)>& ended);

}  // namespace seam::cli
