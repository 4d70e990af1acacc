// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plan.hpp"
#include "tasks.hpp"

namespace seam::cli {

/// One thing that was looked at in a variant.
struct Finding {
  std::string what;  ///< the number of a check, "the run", "agreement over ranks"
  bool holds = false;
  bool is_broken = false;  ///< nothing could be compared: it died, hung or was refused
  std::string message;     ///< of a check: value and what was expected
};

/// What came of a variant.
struct VariantResult {
  std::string scene;
  std::string name;
  std::vector<std::pair<std::string, std::string>> values;  ///< by key of `vary`
  std::string known;              ///< why it falls short today, "" when it is to pass
  std::vector<Finding> findings;  ///< none: it was not run
  std::string command;            ///< which runs it alone, for a shell
  std::filesystem::path log;      ///< empty when it was not run
  double seconds = 0;
  double bytes = 0;  ///< peak memory of all ranks

  [[nodiscard]] bool holds() const;
  /// Neither passed as it should nor fell short as was declared.
  [[nodiscard]] bool is_unexpected() const { return holds() != known.empty(); }
  /// "ok", "known", "FAIL" or "not run".
  [[nodiscard]] std::string verdict() const;
};

/// What `seam check` says of a variant: whether it can be run, and what that takes.
struct Estimate {
  std::string problem;
  double bytes = 0;
  double seconds_per_step = 0;
};

/// Sets up a variant without running it. @param output file that gets what is found, as JSON
Task check_task(const MatrixPlan& plan, const Variant& variant, const std::vector<std::string>& set,
                const std::filesystem::path& output);
Estimate read_estimate(const std::filesystem::path& output, const TaskEnd& end);

/// Runs a variant. @param set of all variants @param folder of its results @param cores that there are
Task run_task(const MatrixPlan& plan, const Variant& variant, const std::vector<std::string>& set,
              const std::filesystem::path& folder, const Estimate& estimate, int cores);

/// A variant before it was run. @param folder of its results; what runs it alone has one beside that
VariantResult describe(const MatrixPlan& plan, const Variant& variant, const std::vector<std::string>& set,
                       const std::filesystem::path& folder);

/// Looks at what its run left. @param checks that the scene has @param limit s that it may take
void judge(VariantResult& result, std::size_t checks, const Task& task, const TaskEnd& end,
           const std::filesystem::path& folder, double limit);

}  // namespace seam::cli
