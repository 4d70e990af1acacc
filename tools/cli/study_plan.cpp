// SPDX-License-Identifier: BSD-3-Clause
#include "study_plan.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common.hpp"
#include "seam/scene/expression.hpp"

namespace seam::cli {
namespace {

constexpr std::size_t most_cases = 10000;
const std::string parameters_prefix = "parameters.";

Scene load(const std::string& file, const std::vector<std::string>& set) {
  Registry registry = builtin_types();
  PluginHost host = PluginHost::standard();
  return load_scene(file, parse_overrides(set), host, registry);
}

/// The key path of a name in `vary`, where a parameter may be called by its name alone.
/// @throws Error for a parameter that the scene does not have: overriding it would make it, and change
/// nothing
std::string key_path(const std::string& name, const Scene& scene, const Location& where) {
  const bool is_prefixed = name.starts_with(parameters_prefix);
  if (!is_prefixed && name.find('.') != std::string::npos) return name;
  const std::string parameter = is_prefixed ? name.substr(parameters_prefix.size()) : name;
  if (scene.parameters.contains(parameter)) return parameters_prefix + parameter;
  std::vector<std::string> known;
  for (const auto& entry : scene.parameters) known.push_back(entry.first);
  const std::string guess = nearest_name(parameter, known);
  throw Error(where, fmt::format("study.vary: the scene has no parameter '{}'.{} It has: {}", parameter,
                                 guess.empty() ? "" : fmt::format(" Did you mean '{}'?", guess),
                                 known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
}

/// Position of a key of `vary` by its name there.
std::size_t find_key(const std::string& name, const Parameters::Value::Map& vary, const Location& where,
                     const std::string& what) {
  std::vector<std::string> known;
  for (const auto& entry : vary) known.push_back(entry.first);
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end())
    throw Error(where, fmt::format("study.{}: '{}' is no key of `vary`. Known: {}", what, name,
                                   fmt::join(known, ", ")));
  return static_cast<std::size_t>(found - known.begin());
}

/// Groups of keys that change together, in the order of `vary`.
std::vector<std::vector<std::size_t>> groups(const Parameters& study, const Parameters::Value::Map& vary) {
  std::vector<bool> is_together(vary.size(), false);
  std::vector<std::size_t> together;
  for (const std::string& name : study.names("together")) {
    const std::size_t key = find_key(name, vary, study.where("together"), "together");
    if (!is_together[key]) together.push_back(key);
    is_together[key] = true;
  }
  const auto count = [&](std::size_t key) { return vary[key].second.names("values").size(); };
  for (const std::size_t key : together)
    if (count(key) != count(together.front()))
      throw Error(
          study.where("together"),
          fmt::format("study.together: '{}' has {} values and '{}' has {}; expected as many of each",
                      vary[together.front()].first, count(together.front()), vary[key].first, count(key)));
  std::vector<std::vector<std::size_t>> result;
  bool placed = false;
  for (std::size_t key = 0; key < vary.size(); ++key) {
    if (!is_together[key]) {
      result.push_back({key});
    } else if (!placed) {
      result.push_back(together);
      placed = true;
    }
  }
  return result;
}

/// All combinations; the last group changes fastest.
std::vector<StudyCase> combinations(const Parameters& study, const Parameters::Value::Map& vary) {
  std::vector<StudyCase> cases(1);
  cases.front().values.resize(vary.size());
  for (const std::vector<std::size_t>& group : groups(study, vary)) {
    const std::size_t count = vary[group.front()].second.names("values").size();
    std::vector<StudyCase> longer;
    for (const StudyCase& one : cases)
      for (std::size_t i = 0; i < count; ++i) {
        longer.push_back(one);
        for (const std::size_t key : group) longer.back().values[key] = vary[key].second.names("values")[i];
        if (longer.size() > most_cases)
          throw Error(study.where("vary"), fmt::format("study.vary: more than {} combinations", most_cases));
      }
    cases = std::move(longer);
  }
  return cases;
}

double number_or_nan(const std::string& text, const std::map<std::string, double>& parameters) {
  try {
    return evaluate_constant(text, parameters);
  } catch (const Error&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

/// Fills the numbers of a case. False when the study leaves it out.
bool examine(StudyCase& one, const StudyPlan& plan, const std::string& file, std::vector<std::string> set) {
  const std::vector<std::string> own = overrides_of(plan, one);
  set.insert(set.end(), own.begin(), own.end());
  const Scene scene = load(file, set);
  const Parameters& study = scene.root.object("study");
  for (const std::string& value : one.values) one.numbers.push_back(number_or_nan(value, scene.parameters));
  if (!std::isfinite(one.numbers[plan.against]))
    throw Error(study.where("vary"),
                fmt::format("study.against: '{}' is '{}', which is no number; choose another key",
                            plan.labels[plan.against], one.values[plan.against]));
  try {
    return !study.has("leave_out") || evaluate_constant(study.text("leave_out"), scene.parameters) == 0;
  } catch (const Error& error) {
    throw Error(study.where("leave_out"), fmt::format("study.leave_out: {}", error.what()));
  }
}

}  // namespace

std::vector<std::string> overrides_of(const StudyPlan& plan, const StudyCase& one) {
  std::vector<std::string> set;
  for (std::size_t k = 0; k < plan.keys.size(); ++k) set.push_back(plan.keys[k] + "=" + one.values[k]);
  return set;
}

StudyPlan plan_study(const std::string& scene_file, const std::vector<std::string>& set) {
  const Scene scene = load(scene_file, set);
  if (!scene.root.has("study"))
    throw Error({scene_file, 0, 0}, "the scene has no `study` block; `seam explain scene` shows its keys");
  const Parameters& study = scene.root.object("study");
  const Parameters::Value::Map& vary = study.map("vary");
  if (vary.empty()) throw Error(study.where("vary"), "study.vary: expected at least one key with its values");

  StudyPlan plan;
  plan.title = scene.root.text("title");
  plan.measures = study.names("measure");
  plan.until_failure = study.boolean("until_failure");
  for (const auto& [name, values] : vary) {
    plan.keys.push_back(key_path(name, scene, values.where()));
    const bool is_parameter = plan.keys.back().starts_with(parameters_prefix);
    plan.labels.push_back(is_parameter ? plan.keys.back().substr(parameters_prefix.size())
                                       : plan.keys.back());
    if (values.names("values").empty())
      throw Error(values.where(), fmt::format("study.vary.{}: no values", name));
  }
  plan.against = study.has("against")
                     ? find_key(study.text("against"), vary, study.where("against"), "against")
                     : vary.size() - 1;
  for (StudyCase& one : combinations(study, vary))
    if (examine(one, plan, scene_file, set)) plan.cases.push_back(std::move(one));
  if (plan.cases.empty()) throw Error(study.where(), "study: `leave_out` leaves out all cases");
  return plan;
}

}  // namespace seam::cli
