// SPDX-License-Identifier: BSD-3-Clause
#include "matrix.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include "../circumstances.hpp"
#include "../command.hpp"
#include "../common.hpp"
#include "agreement.hpp"
#include "coverage.hpp"
#include "matrix_folder.hpp"
#include "report.hpp"
#include "seam/base/policy.hpp"
#include "seam/plugin/plugin_info.hpp"
#include "seam/run/interruption.hpp"
#include "tasks.hpp"
#include "variant_run.hpp"

namespace seam::cli {
namespace {

namespace fs = std::filesystem;

/// Plans, and what is chosen of them, while it is run.
class MatrixRun {
 public:
  MatrixRun(const MatrixOptions& options, const MatrixFolder& folder, const std::vector<MatrixPlan>& plans,
            std::vector<VariantId> chosen)
      : options_(options),
        folder_(folder),
        plans_(plans),
        chosen_(std::move(chosen)),
        machine_(this_machine()) {
    if (options.jobs) machine_.cores = static_cast<int>(*options.jobs);
    machine_.seconds_each = options.seconds_each;
    for (std::size_t i = 0; i < chosen_.size(); ++i)
      results_.push_back(describe(plan(i), variant(i), options_.set, folder_of(i)));
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
      folder_.make_new(folder_of(i));
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
      judge(results_[places[task]], plan(places[task]).checks, tasks[task], end, folder_of(places[task]),
            machine_.seconds_each);
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
    fmt::print("[{}/{}] {}", said_, chosen_.size(), as_text(results_[i], must_agree(i)));
    std::fflush(stdout);
  }

  [[nodiscard]] bool must_agree(std::size_t i) const {
    for (const Agreement& agreement : plan(i).agreements)
      for (const std::vector<std::size_t>& group : agreement.groups)
        if (std::ranges::find(group, chosen_[i].second) != group.end()) return true;
    return false;
  }

  const MatrixOptions& options_;
  const MatrixFolder& folder_;
  const std::vector<MatrixPlan>& plans_;
  std::vector<VariantId> chosen_;
  Machine machine_;
  std::vector<Estimate> estimates_;     ///< by the order chosen
  std::vector<VariantResult> results_;  ///< likewise
  std::size_t said_ = 0;
};

/// What runs it again.
std::string command_line(const MatrixOptions& options) {
  std::string text = "seam verify --matrix " + fmt::format("{}", fmt::join(options.scenes, " "));
  if (options.selection.tier != "fast") text += " --tier " + options.selection.tier;
  for (const std::string& value : options.set) text += fmt::format(" --set '{}'", value);
  if (!options.selection.filter.empty()) text += fmt::format(" --filter '{}'", options.selection.filter);
  if (const auto& shard = options.selection.shard)
    text += fmt::format(" --shard {}/{}", shard->first, shard->second);
  for (const std::string& word : trust_as_words()) text += " " + word;
  return text;
}

std::vector<std::pair<std::string, std::string>> circumstances_of(const MatrixOptions& options) {
  auto around = circumstances(options.scenes.front(), host_fingerprint());
  around.emplace_back("each variant",
                      "one core a rank, as many at once as cores and memory allow; seconds by the clock");
  around.emplace_back("command", command_line(options));
  return around;
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

/// The types that must be used, as a row of the table.
VariantResult cover(const Coverage& coverage, const std::vector<std::string>& plugins) {
  const std::set<std::string> known = coverage.plugins();
  for (const std::string& plugin : plugins)
    if (!known.contains(plugin))
      throw Error(fmt::format("--cover {}: no scene loads such a plugin. Loaded: {}", plugin,
                              fmt::join(known, ", ")));
  VariantResult row;
  row.scene = "coverage";
  row.name = fmt::format("types of {}", fmt::join(plugins, ", "));
  for (const std::string& type : coverage.unused_types({plugins.begin(), plugins.end()}))
    row.findings.push_back({type, false, false, "no variant uses it"});
  if (row.findings.empty()) row.findings.push_back({"each type", true, false, ""});
  return row;
}

/// A scene that cannot be read is a row like any other.
MatrixPlan plan_or_problem(const FoundScene& scene, const std::vector<std::string>& set) {
  MatrixPlan plan;
  try {
    plan = plan_matrix(scene.file, set);
  } catch (const Error& error) {
    plan.scene = scene.file;
    plan.variants.emplace_back().problem = error.what();
  }
  plan.is_named = scene.is_named;
  return plan;
}

/// @returns whether all can be read
bool print_list(const std::vector<MatrixPlan>& plans, const std::vector<VariantId>& chosen) {
  bool all_read = true;
  for (const auto& [p, v] : chosen) {
    const Variant& variant = plans[p].variants[v];
    fmt::print("{}: {}{}\n", on_one_line(plans[p].scene.string()),
               variant.name.empty() ? "as it stands" : on_one_line(variant.name),
               variant.known.empty() ? "" : fmt::format("  (known: {})", on_one_line(variant.known)));
    if (!variant.problem.empty()) fmt::print(stderr, "{}\n", variant.problem);
    all_read = all_read && variant.problem.empty();
  }
  fmt::print("{} variant{} of {} scene{}\n", chosen.size(), chosen.size() == 1 ? "" : "s", plans.size(),
             plans.size() == 1 ? "" : "s");
  return all_read;
}

/// What was not known when a variant ended: whether it agrees with others.
void print_agreements(const std::vector<VariantResult>& results) {
  for (const VariantResult& result : results) {
    const bool fell_apart = std::ranges::any_of(
        result.findings, [](const Finding& f) { return !f.holds && f.what.starts_with("agreement"); });
    const bool passes_known = result.verdict() == "FAIL" && result.holds();
    if (fell_apart || passes_known) fmt::print("{}", as_text(result));
  }
}

/// Why nothing is to be run. @returns an ExitCode
int report_nothing(const std::vector<MatrixPlan>& plans, const Selection& selection) {
  if (selection.failed && selection.failed->empty()) {
    fmt::print("nothing failed last time\n");
    return ok;
  }
  // A shard may be empty: there may be more of them than variants.
  Selection without_shard = selection;
  without_shard.shard.reset();
  if (selection.shard && !select(plans, without_shard).empty()) {
    fmt::print("0 variants: 0 ok, 0 known to fall short, 0 failed\n  the shard is empty\n");
    return ok;
  }
  Selection any_tier = selection;
  any_tier.tier = "all";
  const std::size_t others = select(plans, any_tier).size();
  fmt::print("no variant is such{}\n",
             others == 0 ? "" : fmt::format(": {} in scenes of another tier, see --tier", others));
  return broken_input;
}

}  // namespace

int verify_matrix(const MatrixOptions& options) {
  Selection selection = options.selection;
  std::vector<MatrixPlan> plans;
  for (const FoundScene& scene : find_scenes(options.scenes))
    plans.push_back(plan_or_problem(scene, options.set));
  std::unique_ptr<MatrixFolder> folder;
  if (!options.list || options.failed) folder = std::make_unique<MatrixFolder>(options.folder);
  if (options.failed) selection.failed = folder->failed_last_time(plans);
  const std::vector<VariantId> chosen = select(plans, selection);
  const bool all_read = !options.list || print_list(plans, chosen);
  std::vector<VariantResult> results;
  if (options.coverage || !options.cover.empty()) {
    const Coverage coverage = find_coverage(plans, chosen, options.set);
    if (options.coverage) fmt::print("{}\n", coverage.as_markdown());
    if (!options.cover.empty()) results.push_back(cover(coverage, options.cover));
    for (const VariantResult& row : results)
      if (!row.holds()) fmt::print("{}", as_text(row));
  }
  if (options.list) return all_read && count(results).failed == 0 ? ok : failed;
  if (chosen.empty()) return report_nothing(plans, selection);
  MatrixRun matrix(options, *folder, plans, chosen);
  folder->write_table(matrix.results(), plans);
  const int signal = matrix.run();
  results.insert(results.begin(), matrix.results().begin(), matrix.results().end());
  print_agreements(results);
  folder->write(results, plans, circumstances_of(options));
  const MatrixCount n = count(results);
  fmt::print("{} variant{}: {} ok, {} known to fall short, {} failed\n  tables: {}\n",
             results.size() - n.not_run, results.size() - n.not_run == 1 ? "" : "s", n.ok, n.known, n.failed,
             on_one_line((options.folder / "matrix.md").string()));
  if (signal != 0) {
    fmt::print(stderr, "interrupted by {}: {} of {} variants were not run; --failed runs them\n",
               signal_name(signal), n.not_run, results.size());
    constexpr int by_signal = 128;
    return by_signal + signal;
  }
  return n.failed == 0 ? ok : failed;
}

}  // namespace seam::cli
