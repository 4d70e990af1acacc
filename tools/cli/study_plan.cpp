// SPDX-License-Identifier: BSD-3-Clause
#include "study_plan.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "common.hpp"
#include "condition.hpp"
#include "seam/scene/expression.hpp"
#include "vary.hpp"

namespace seam::cli {
namespace {

Scene load(const std::string& file, const std::vector<std::string>& set) {
  Registry registry = builtin_types();
  PluginHost host = PluginHost::standard();
  return load_scene(file, parse_overrides(set), host, registry);
}

double number_or_nan(const std::string& text, const std::map<std::string, double>& parameters) {
  try {
    return evaluate_constant(text, parameters);
  } catch (const Error&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

/// Fills the numbers of a case. False when the study leaves it out.
bool examine(StudyCase& one, const StudyPlan& plan, const Vary& vary, const std::string& file,
             std::vector<std::string> set) {
  const std::vector<std::string> own = overrides_of(plan, one);
  set.insert(set.end(), own.begin(), own.end());
  const Scene scene = load(file, set);
  const Parameters& study = scene.root.object("study");
  for (const std::string& value : one.values) one.numbers.push_back(number_or_nan(value, scene.parameters));
  if (!std::isfinite(one.numbers[plan.against]))
    throw Error(study.where("vary"),
                fmt::format("study.against: '{}' is '{}', which is no number; choose another key",
                            plan.labels[plan.against], one.values[plan.against]));
  return !study.has("leave_out") || !Condition(vary, scene.parameters, study.text("leave_out"),
                                               study.where("leave_out"), "study.leave_out")
                                         .holds(one.values, scene.parameters);
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
  const Vary vary = read_vary(study, "study", scene);

  StudyPlan plan;
  plan.title = scene.root.text("title");
  plan.measures = study.names("measure");
  plan.until_failure = study.boolean("until_failure");
  for (const Vary::Key& key : vary.keys) {
    plan.keys.push_back(key.path);
    plan.labels.push_back(key.label);
  }
  plan.against = study.has("against")
                     ? find_key(vary, study.text("against"), study.where("against"), "study.against")
                     : vary.keys.size() - 1;
  for (std::vector<std::string>& values : combinations(vary, study.where("vary"))) {
    StudyCase one{std::move(values), {}};
    if (examine(one, plan, vary, scene_file, set)) plan.cases.push_back(std::move(one));
  }
  if (plan.cases.empty()) throw Error(study.where(), "study: `leave_out` leaves out all cases");
  return plan;
}

}  // namespace seam::cli
