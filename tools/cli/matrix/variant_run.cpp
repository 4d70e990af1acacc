// SPDX-License-Identifier: BSD-3-Clause
#include "variant_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "../command.hpp"
#include "../json_file.hpp"
#include "../mpirun.hpp"
#include "../rank_runs.hpp"
#include "seam/base/program.hpp"

namespace seam::cli {
namespace {

const std::string the_run = "the run";

/// One word of a shell.
std::string quoted(const std::string& word) {
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string as_shell(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + quoted(word);
  return text;
}

void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
}

std::vector<std::string> set_words(const std::vector<std::string>& set, const Variant& variant) {
  std::vector<std::string> words;
  for (const std::vector<std::string>* values : {&set, &variant.set})
    for (const std::string& value : *values) append(words, {"--set", value});
  return words;
}

/// The commands of a variant, without what says how they report.
std::vector<std::vector<std::string>> commands(const MatrixPlan& plan, const Variant& variant,
                                               const std::vector<std::string>& set,
                                               const std::string& program) {
  const auto on = [&](int ranks) {
    std::vector<std::string> words = ranks == 1 ? std::vector<std::string>() : mpirun(ranks);
    append(words, {program, "run", plan.scene.string()});
    append(words, set_words(set, variant));
    return words;
  };
  std::vector<std::vector<std::string>> all{on(variant.ranks)};
  if (variant.resume_ranks) {
    append(all.front(), {"--stop-at", fmt::format("{}", plan.middle)});
    all.push_back(on(*variant.resume_ranks));
    all.back().emplace_back("--resume");
  }
  return all;
}

/// Why a run ended without having come to its end.
std::string why_it_broke_off(const Task& task, const TaskEnd& end, double limit) {
  constexpr int by_signal = 128, not_started = 127;
  if (end.out_of_time)
    return fmt::format("it took longer than the {:.6g} s that it may, and was ended", limit);
  std::string said = first_lines(task.steps[end.last].output);
  if (!said.empty()) said.insert(0, "\n");
  if (end.code == not_started)
    return has_mpirun() ? "it could not be started"
                        : "it could not be started: there is no mpirun on the PATH";
  if (end.code > by_signal)
    return fmt::format("it was ended by signal {} ({}){}", end.code - by_signal,
                       strsignal(end.code - by_signal), said);
  return fmt::format("exit code {}{}", end.code, said);
}

}  // namespace

bool VariantResult::holds() const { return std::ranges::all_of(findings, &Finding::holds); }

std::string VariantResult::verdict() const {
  if (findings.empty()) return "not run";
  if (is_unexpected()) return "FAIL";
  return known.empty() ? "ok" : "known";
}

Task check_task(const MatrixPlan& plan, const Variant& variant, const std::vector<std::string>& set,
                const std::filesystem::path& output) {
  std::vector<std::string> words{own_executable().string(), "check", plan.scene.string(), "--json",
                                 "--without-matrix"};
  append(words, set_words(set, variant));
  append(words, trust_as_words());
  Task task;
  task.steps.push_back({std::move(words), output});
  return task;
}

Estimate read_estimate(const std::filesystem::path& output, const TaskEnd& end) {
  const nlohmann::json found = read_json(output);
  Estimate estimate;
  if (!found.is_object()) {
    estimate.problem = end.out_of_time ? "`seam check` takes longer than a run may"
                                       : fmt::format("`seam check` ends with exit code {}\n{}", end.code,
                                                     first_lines(output));
    return estimate;
  }
  if (!found.value("ok", false))
    for (const nlohmann::json& d : found.value("diagnostics", nlohmann::json::array()))
      if (d.value("severity", "") == "error")
        estimate.problem += (estimate.problem.empty() ? "" : "\n") + d.value("message", "");
  estimate.bytes = found.value("memory_bytes", 0.0);
  estimate.seconds_per_step = found.value("seconds_per_step", 0.0);
  return estimate;
}

Task run_task(const MatrixPlan& plan, const Variant& variant, const std::vector<std::string>& set,
              const std::filesystem::path& folder, const Estimate& estimate, int cores) {
  Task task;
  for (std::vector<std::string>& words : commands(plan, variant, set, own_executable().string())) {
    append(words, {"--quiet", "--no-picture", "--folder", folder.string()});
    append(words, trust_as_words());
    const std::string log = task.steps.empty() ? "log.txt" : "log-resumed.txt";
    task.steps.push_back({std::move(words), folder / log});
  }
  task.cores = std::min(cores, std::max(variant.ranks, variant.resume_ranks.value_or(1)));
  task.bytes = estimate.bytes;
  task.seconds = estimate.seconds_per_step * plan.steps;
  return task;
}

VariantResult describe(const MatrixPlan& plan, const Variant& variant, const std::vector<std::string>& set,
                       const std::filesystem::path& folder) {
  VariantResult result;
  result.scene = plan.scene.string();
  result.name = variant.name;
  result.known = variant.known;
  for (std::size_t k = 0; k < variant.values.size(); ++k)
    result.values.emplace_back(plan.keys[k], variant.values[k]);
  for (std::vector<std::string> words : commands(plan, variant, set, "seam")) {
    append(words, trust_as_words());
    append(words, {"--folder", folder.string() + "-alone"});
    if (result.command.empty()) words.emplace_back("--overwrite");
    result.command += (result.command.empty() ? "" : " && ") + as_shell(words);
  }
  return result;
}

void judge(VariantResult& result, std::size_t checks, const Task& task, const TaskEnd& end,
           const std::filesystem::path& folder, double limit) {
  result.log = task.steps[end.last].output;
  result.seconds = end.seconds;
  const nlohmann::json summary = read_json(folder / "summary.json");
  const bool is_finished = summary.is_object() && summary.value("status", "") == "finished";
  // A check that fails makes exit code 1, too.
  const bool is_well = is_finished && !end.out_of_time && end.last + 1 == task.steps.size() &&
                       (end.code == ok || end.code == failed);
  result.findings.push_back({the_run, is_well, !is_well, is_well ? "" : why_it_broke_off(task, end, limit)});
  if (!is_well) return;
  result.bytes = summary.value("peak_memory_bytes", 0.0);
  const nlohmann::json& found = summary.at("checks");
  if (found.size() < checks) {
    result.findings.front() = {
        the_run, false, true,
        "its first part came to the end of the scene's time: no step ends in its middle"};
    return;
  }
  std::map<std::string, int> times;  // a number may be checked at several times
  for (const nlohmann::json& check : found) {
    const std::string that = check.at("that");
    const int time = ++times[that];
    const nlohmann::json& value = check.at("value");
    result.findings.push_back(
        {time == 1 ? that : fmt::format("{} ({})", that, time), check.at("passed"), false,
         fmt::format("{}, expected {}",
                     value.is_number() ? fmt::format("{:.6g}", value.get<double>()) : "no number",
                     check.at("expected").get<std::string>())});
  }
  if (result.holds() && end.code != ok)
    result.findings.front() = {the_run, false, true, why_it_broke_off(task, end, limit)};
}

}  // namespace seam::cli
