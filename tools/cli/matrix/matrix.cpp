// SPDX-License-Identifier: BSD-3-Clause
#include "matrix.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "../circumstances.hpp"
#include "../command.hpp"
#include "../common.hpp"
#include "../json_file.hpp"
#include "agreement.hpp"
#include "coverage.hpp"
#include "report.hpp"
#include "seam/output/atomic_file.hpp"
#include "seam/plugin/plugin_info.hpp"
#include "seam/run/interruption.hpp"
#include "tasks.hpp"
#include "variant_run.hpp"

namespace seam::cli {
namespace {

namespace fs = std::filesystem;

const std::string table_name = "matrix.json";

/// What failed when the folder was last written to. @throws Error when there is nothing
std::set<std::pair<std::string, std::string>> failed_last_time(const fs::path& folder) {
  const nlohmann::json last = read_json(folder / table_name);
  if (!last.is_object() || !last.contains("variants"))
    throw Error({(folder / table_name).string()},
                "--failed: there is no table of an earlier run; run without it first");
  std::set<std::pair<std::string, std::string>> failed;
  for (const nlohmann::json& variant : last.at("variants"))
    if (variant.value("verdict", "") == "FAIL")
      failed.emplace(variant.value("scene", ""), variant.value("variant", ""));
  return failed;
}

/// The folder is this command's own, or is made. @throws Error when something else is in it
void take_folder(const fs::path& folder) {
  if (fs::exists(folder) && !fs::is_empty(folder) && !fs::exists(folder / table_name))
    throw Error({folder.string()},
                fmt::format("the folder holds what `seam verify --matrix` did not write ({} is not in it); "
                            "choose another --folder",
                            table_name));
  fs::create_directories(folder);
}

/// Plans, and what is chosen of them, while it is run.
class MatrixRun {
 public:
  MatrixRun(const MatrixOptions& options, std::vector<MatrixPlan> plans, std::vector<VariantId> chosen)
      : options_(options), plans_(std::move(plans)), chosen_(std::move(chosen)), machine_(this_machine()) {
    if (options.jobs) machine_.cores = static_cast<int>(*options.jobs);
    machine_.seconds_each = options.seconds_each;
    for (const auto& [p, v] : chosen_)
      results_.push_back(describe(plans_[p], plans_[p].variants[v], options_.set));
  }

  /// @returns the signal that ended it, or 0
  int run() {
    const SignalWatch watch;
    int signal = estimate();
    if (signal == 0) signal = run_all();
    for (std::size_t p = 0; p < plans_.size() && signal == 0; ++p) compare_plan(p);
    return signal;
  }

  [[nodiscard]] const std::vector<VariantResult>& results() const { return results_; }
  /// Those that came to an end before a signal did.
  [[nodiscard]] std::vector<VariantResult> ended() const {
    std::vector<VariantResult> all;
    for (const VariantResult& result : results_)
      if (!result.findings.empty()) all.push_back(result);
    return all;
  }

 private:
  [[nodiscard]] const MatrixPlan& plan(std::size_t i) const { return plans_[chosen_[i].first]; }
  [[nodiscard]] const Variant& variant(std::size_t i) const { return plan(i).variants[chosen_[i].second]; }
  /// Numbers, since names of variants may be long, and hold what a path may not.
  [[nodiscard]] fs::path folder_of(std::size_t i) const {
    return options_.folder / fmt::format("{:03}-{}", chosen_[i].first + 1, plan(i).scene.stem().string()) /
           fmt::format("{:03}", chosen_[i].second + 1);
  }

  /// Sets each variant up that differs by more than ranks and restarts.
  int estimate() {
    std::vector<Task> tasks;
    std::vector<fs::path> outputs;
    std::map<std::pair<std::size_t, std::vector<std::string>>, std::size_t> numbers;
    std::vector<std::size_t> task_of(chosen_.size());
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      fs::remove_all(folder_of(i));
      fs::create_directories(folder_of(i));
      if (!variant(i).problem.empty()) continue;
      const auto [entry, is_new] = numbers.try_emplace({chosen_[i].first, variant(i).set}, tasks.size());
      task_of[i] = entry->second;
      if (!is_new) continue;
      outputs.push_back(folder_of(i) / "check.json");
      tasks.push_back(check_task(plan(i), variant(i), options_.set, outputs.back()));
    }
    std::vector<Estimate> found(tasks.size());
    const int signal = run_tasks(tasks, machine_, [&](std::size_t task, const TaskEnd& end) {
      found[task] = read_estimate(outputs[task], end);
    });
    for (std::size_t i = 0; i < chosen_.size(); ++i)
      estimates_.push_back(variant(i).problem.empty() ? found[task_of[i]] : Estimate{variant(i).problem});
    return signal;
  }

  int run_all() {
    std::vector<Task> tasks;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      if (!estimates_[i].problem.empty()) {
        results_[i].findings.push_back({"the run", false, true, estimates_[i].problem});
        say(i);
        continue;
      }
      tasks.push_back(
          run_task(plan(i), variant(i), options_.set, folder_of(i), estimates_[i], machine_.cores));
      places.push_back(i);
    }
    return run_tasks(tasks, machine_, [&](std::size_t task, const TaskEnd& end) {
      judge(results_[places[task]], plan(places[task]).checks, tasks[task], end, folder_of(places[task]));
      say(places[task]);
    });
  }

  void compare_plan(std::size_t p) {
    std::vector<VariantResult*> results(plans_[p].variants.size());
    std::map<std::size_t, std::size_t> places;
    for (std::size_t i = 0; i < chosen_.size(); ++i)
      if (chosen_[i].first == p) {
        results[chosen_[i].second] = &results_[i];
        places[chosen_[i].second] = i;
      }
    compare(plans_[p], results, [&](std::size_t v) { return folder_of(places.at(v)); });
  }

  /// What has come to its end, as it does: whether it agrees with others is not known yet.
  void say(std::size_t i) {
    ++said_;
    fmt::print("[{}/{}] {}", said_, chosen_.size(), as_text(results_[i]));
    std::fflush(stdout);
  }

  const MatrixOptions& options_;
  std::vector<MatrixPlan> plans_;
  std::vector<VariantId> chosen_;
  Machine machine_;
  std::vector<Estimate> estimates_;     ///< by the order chosen
  std::vector<VariantResult> results_;  ///< likewise
  std::size_t said_ = 0;
};

/// The table with what an earlier one says of variants that were not run now.
nlohmann::json merged(const nlohmann::json& now, const fs::path& file) {
  const nlohmann::json last = read_json(file);
  if (!last.is_object()) return now;
  nlohmann::json all = last;
  for (const nlohmann::json& variant : now.at("variants"))
    for (nlohmann::json& before : all["variants"])
      if (before.at("scene") == variant.at("scene") && before.at("variant") == variant.at("variant"))
        before = variant;
  return all;
}

/// What runs it again.
std::string command_line(const MatrixOptions& options) {
  std::string text = fmt::format("seam verify --matrix {} --tier {}", fmt::join(options.scenes, " "),
                                 options.selection.tier);
  for (const std::string& value : options.set) text += fmt::format(" --set '{}'", value);
  if (!options.selection.filter.empty()) text += fmt::format(" --filter '{}'", options.selection.filter);
  if (const auto& shard = options.selection.shard)
    text += fmt::format(" --shard {}/{}", shard->first, shard->second);
  return text;
}

void put(const MatrixOptions& options, const std::string& name, const std::string& text) {
  write_text_atomically((options.folder / name).string(), text);
}

void write(const std::vector<VariantResult>& results, const MatrixOptions& options) {
  nlohmann::json table = as_json(results);
  if (options.failed) table = merged(table, options.folder / table_name);
  put(options, table_name, table.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  auto around = circumstances(options.scenes.front(), host_fingerprint());
  around.emplace_back("each variant",
                      "one core a rank, as many at once as cores and memory allow; seconds by the clock");
  around.emplace_back("command", command_line(options));
  put(options, "matrix.md", as_markdown(results, around));
  put(options, "junit.xml", as_junit(results));
}

/// What the chosen variants use.
Coverage find_coverage(const std::vector<MatrixPlan>& plans, const std::vector<VariantId>& chosen,
                       const std::vector<std::string>& set) {
  Coverage coverage;
  std::set<std::pair<std::size_t, std::vector<std::string>>> seen;
  for (const auto& [p, v] : chosen) {
    const Variant& variant = plans[p].variants[v];
    if (!variant.problem.empty() || !seen.emplace(p, variant.set).second) continue;
    std::vector<std::string> all = set;
    all.insert(all.end(), variant.set.begin(), variant.set.end());
    Registry registry = builtin_types();
    PluginHost host = PluginHost::standard();
    const Scene scene = load_scene(plans[p].scene, parse_overrides(all), host, registry);
    coverage.add(scene, registry);
  }
  return coverage;
}

/// @returns how many types are not used that must be
std::size_t report(const Coverage& coverage, const MatrixOptions& options) {
  if (options.coverage) fmt::print("{}\n", coverage.as_markdown());
  const std::set<std::string> known = coverage.plugins();
  for (const std::string& plugin : options.cover)
    if (!known.contains(plugin))
      throw Error(fmt::format("--cover {}: no scene loads such a plugin. Loaded: {}", plugin,
                              fmt::join(known, ", ")));
  const std::vector<std::string> unused = coverage.unused_types({options.cover.begin(), options.cover.end()});
  for (const std::string& type : unused) fmt::print("FAIL {}: no variant uses it\n", type);
  return unused.size();
}

/// A scene that cannot be read is a row like any other.
MatrixPlan plan_or_problem(const fs::path& scene, const std::vector<std::string>& set) {
  try {
    return plan_matrix(scene, set);
  } catch (const Error& error) {
    MatrixPlan plan;
    plan.scene = scene;
    plan.variants.emplace_back().problem = error.what();
    return plan;
  }
}

void print_list(const std::vector<MatrixPlan>& plans, const std::vector<VariantId>& chosen) {
  for (const auto& [p, v] : chosen) {
    const Variant& variant = plans[p].variants[v];
    fmt::print("{}: {}{}\n", plans[p].scene.string(), variant.name.empty() ? "as it stands" : variant.name,
               variant.known.empty() ? "" : fmt::format("  (known: {})", variant.known));
  }
  fmt::print("{} variants of {} scenes\n", chosen.size(), plans.size());
}

/// What agreements found is not known when a variant ends.
void print_disagreements(const std::vector<VariantResult>& results) {
  for (const VariantResult& result : results)
    if (result.is_unexpected() && std::ranges::any_of(result.findings, [](const Finding& f) {
          return !f.holds && f.what.starts_with("agreement");
        }))
      fmt::print("{}", as_text(result));
}

}  // namespace

int verify_matrix(const MatrixOptions& options) {
  Selection selection = options.selection;
  if (options.failed) selection.failed = failed_last_time(options.folder);
  std::vector<MatrixPlan> plans;
  for (const fs::path& scene : find_scenes(options.scenes))
    plans.push_back(plan_or_problem(scene, options.set));
  std::vector<VariantId> chosen = select(plans, selection);
  std::size_t unused = 0;
  const bool wants_coverage = options.coverage || !options.cover.empty();
  if (options.list) print_list(plans, chosen);
  if (wants_coverage) unused = report(find_coverage(plans, chosen, options.set), options);
  if (options.list) return unused == 0 ? ok : failed;
  if (chosen.empty()) {
    fmt::print("{}\n", options.failed ? "nothing failed last time" : "no variant is such");
    return options.failed ? ok : broken_input;
  }
  take_folder(options.folder);
  MatrixRun matrix(options, std::move(plans), std::move(chosen));
  const int signal = matrix.run();
  const std::vector<VariantResult> results = matrix.ended();
  print_disagreements(results);
  write(results, options);
  const MatrixCount n = count(results);
  fmt::print("{} variant{}: {} ok, {} known to fall short, {} failed\n  tables: {}\n", results.size(),
             results.size() == 1 ? "" : "s", n.ok, n.known, n.failed,
             (options.folder / "matrix.md").string());
  constexpr int by_signal = 128;
  if (signal != 0) {
    fmt::print(stderr, "interrupted by {}: {} of {} variants are not in the tables\n", signal_name(signal),
               matrix.results().size() - results.size(), matrix.results().size());
    return by_signal + signal;
  }
  return n.failed == 0 && unused == 0 ? ok : failed;
}

}  // namespace seam::cli
