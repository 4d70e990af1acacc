// SPDX-License-Identifier: BSD-3-Clause
#include "plan.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "../common.hpp"
#include "../condition.hpp"
#include "../vary.hpp"
#include "pairs.hpp"

namespace seam::cli {
namespace {

const std::string ranks_word = "ranks", restart_word = "restart", no_restart = "none";

bool is_own_word(const std::string& name) { return name == ranks_word || name == restart_word; }

Scene load(const std::filesystem::path& file, const std::vector<std::string>& set) {
  Registry registry = builtin_types();
  PluginHost host = PluginHost::standard();
  return load_scene(file, parse_overrides(set), host, registry);
}

int number_of_ranks(const std::string& text, const Vary::Key& key) {
  constexpr int most = 1024;
  int ranks = 0;
  const char* last = text.data() + text.size();
  const auto [end, code] = std::from_chars(text.data(), last, ranks);
  if (code == std::errc{} && end == last && ranks >= 1 && ranks <= most) return ranks;
  throw Error(key.where,
              fmt::format("matrix.vary.{}: found '{}', expected a number of ranks from 1 to {}{}", key.label,
                          text, most, key.path == restart_word ? ", or `none` for a run in one piece" : ""));
}

std::string name_of(const Vary& vary, const std::vector<std::string>& values) {
  std::string name;
  for (std::size_t k = 0; k < values.size(); ++k)
    name += fmt::format("{}{}={}", k == 0 ? "" : " ", vary.keys[k].label, values[k]);
  return name;
}

/// How a scene steps through its time.
struct TimeSpan {
  double steps = 1;   ///< about how many
  double middle = 0;  ///< s
};

TimeSpan time_of(const Scene& scene) {
  if (!scene.root.has("time")) return {};
  const Parameters& time = scene.root.object("time");
  const double start = time.number("start"), span = time.number("end") - start;
  TimeSpan result{1, start + span / 2};
  if (!time.has("step")) return result;
  // Steps that are taken again are not counted: there are more than one.
  const Parameters& step = time.object("step");
  constexpr double many = 100;
  result.steps = step.has("initial") ? std::max(1.0, std::ceil(span / step.number("initial") - 1e-9)) : many;
  return result;
}

/// What a scene says with the values of a variant.
struct Reading {
  std::string problem;
  std::map<std::string, double> parameters;
};

/// Makes the variants of a block, one step after the other.
class Planner {
 public:
  Planner(const Scene& scene, const std::vector<std::string>& set)
      : scene_(scene),
        set_(set),
        block_(scene.root.object("matrix")),
        vary_(read_vary(block_, "matrix", scene, is_own_word)) {}

  void plan(MatrixPlan& plan) {
    for (const Vary::Key& key : vary_.keys) {
      plan.keys.push_back(key.label);
      if (key.path == restart_word) require_middle(key);
    }
    std::size_t left_out = 0;
    std::set<std::string> names;
    for (const std::vector<std::string>& values : combinations(vary_, block_.where("vary"))) {
      Variant variant = make(values);
      if (is_left_out(variant)) {
        ++left_out;
      } else if (!names.insert(variant.name).second) {
        throw Error(block_.where("vary"),
                    fmt::format("matrix.vary: a value stands there twice: there are two variants '{}'",
                                variant.name));
      } else {
        plan.variants.push_back(std::move(variant));
      }
    }
    if (block_.has("leave_out") && left_out == 0)
      throw Error(block_.where("leave_out"),
                  "matrix.leave_out: no variant is such; take it out, or mend the condition");
    if (plan.variants.empty()) throw Error(block_.where(), "matrix: `leave_out` leaves out all variants");
    refuse_values_that_never_do(plan.variants);
    mark_known(plan.variants);
    if (block_.text("combine") == "pairs")
      plan.variants = fewest_with_all_pairs(keys_of_agreements(), std::move(plan.variants));
    for (const Parameters& agreement : block_.list("agree"))
      plan.agreements.push_back(agree(agreement, plan.variants));
  }

 private:
  Variant make(const std::vector<std::string>& values) {
    Variant variant;
    variant.values = values;
    variant.name = name_of(vary_, values);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const Vary::Key& key = vary_.keys[k];
      if (key.path == ranks_word)
        variant.ranks = number_of_ranks(values[k], key);
      else if (key.path == restart_word)
        variant.resume_ranks =
            values[k] == no_restart ? std::nullopt : std::optional(number_of_ranks(values[k], key));
      else
        variant.set.push_back(key.path + "=" + values[k]);
    }
    variant.problem = read(variant.set).problem;
    return variant;
  }

  /// Variants that differ in ranks and restarts alone are read once.
  const Reading& read(const std::vector<std::string>& own) {
    const auto [entry, is_new] = readings_.try_emplace(own);
    if (!is_new) return entry->second;
    std::vector<std::string> all = set_;
    all.insert(all.end(), own.begin(), own.end());
    try {
      entry->second.parameters = load(scene_.path, all).parameters;
    } catch (const Error& error) {
      entry->second = {error.what(), scene_.parameters};
    }
    return entry->second;
  }

  bool is_left_out(const Variant& variant) {
    if (!block_.has("leave_out")) return false;
    return Condition(vary_, scene_.parameters, block_.text("leave_out"), block_.where("leave_out"),
                     "matrix.leave_out")
        .holds(variant.values, read(variant.set).parameters);
  }

  /// A run without time takes one step: there is nothing to go on with.
  void require_middle(const Vary::Key& key) const {
    const bool has_steps = time_of(scene_).steps > 1;
    if (!has_steps)
      throw Error(
          key.where,
          "matrix.vary.restart: the scene takes a single step, so that no run can be ended in its middle");
  }

  void refuse_values_that_never_do(const std::vector<Variant>& variants) const {
    for (std::size_t k = 0; k < vary_.keys.size(); ++k)
      for (const std::string& value : vary_.keys[k].values) {
        const Variant* first = nullptr;
        bool does = false;
        for (const Variant& variant : variants) {
          if (variant.values[k] != value) continue;
          if (!first) first = &variant;
          does = does || variant.problem.empty();
        }
        if (first && !does)
          throw Error(vary_.keys[k].where,
                      fmt::format("matrix.vary.{}: the scene cannot be read with '{}', whatever the other "
                                  "keys are; with {}:\n{}",
                                  vary_.keys[k].label, value, first->name, first->problem));
      }
  }

  void mark_known(std::vector<Variant>& variants) {
    for (const Parameters& known : block_.list("known")) {
      const Condition condition(vary_, scene_.parameters, known.text("when"), known.where("when"),
                                "matrix.known");
      if (known.text("reason").empty())
        throw Error(known.where("reason"), "matrix.known.reason: say why these variants fall short");
      bool any = false;
      for (Variant& variant : variants) {
        if (!condition.holds(variant.values, read(variant.set).parameters)) continue;
        any = true;
        if (variant.known.empty()) variant.known = known.text("reason");
      }
      if (!any)
        throw Error(known.where("when"),
                    "matrix.known: no variant is such; take it out, or mend the condition");
    }
  }

  [[nodiscard]] std::set<std::size_t> keys_over(const Parameters& agreement) const {
    std::set<std::size_t> over;
    for (const std::string& name : agreement.names("over")) {
      const std::size_t key = find_key(vary_, name, agreement.where("over"), "matrix.agree.over");
      // Keys that change together are one.
      for (const std::vector<std::size_t>& group : vary_.groups)
        if (std::ranges::find(group, key) != group.end()) over.insert(group.begin(), group.end());
    }
    return over;
  }

  [[nodiscard]] std::set<std::size_t> keys_of_agreements() const {
    std::set<std::size_t> all;
    for (const Parameters& agreement : block_.list("agree")) all.merge(keys_over(agreement));
    return all;
  }

  [[nodiscard]] Agreement agree(const Parameters& p, const std::vector<Variant>& variants) const {
    const std::set<std::size_t> over = keys_over(p);
    Agreement agreement{fmt::format("{}", fmt::join(p.names("over"), ", ")),
                        p.names("series"),
                        p.where("series"),
                        p.number("within"),
                        {}};
    std::map<std::vector<std::string>, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < variants.size(); ++i) {
      std::vector<std::string> others;
      for (std::size_t k = 0; k < variants[i].values.size(); ++k)
        if (!over.contains(k)) others.push_back(variants[i].values[k]);
      groups[others].push_back(i);
    }
    for (auto& entry : groups)
      if (entry.second.size() > 1) agreement.groups.push_back(std::move(entry.second));
    if (agreement.groups.empty())
      throw Error(p.where("over"),
                  fmt::format("matrix.agree: no two variants differ in {} alone; nothing would be compared",
                              agreement.over.empty() ? "these keys" : agreement.over));
    return agreement;
  }

  const Scene& scene_;
  const std::vector<std::string>& set_;
  const Parameters& block_;
  Vary vary_;
  std::map<std::vector<std::string>, Reading> readings_;
};

}  // namespace

std::string describe(const Agreement& agreement) {
  return "agreement over " + agreement.over +
         (agreement.series.empty() ? "" : fmt::format(" of {}", fmt::join(agreement.series, ", ")));
}

bool is_series(const std::string& column, const std::string& name) {
  return column == name ||
         (column.size() > name.size() + 1 && column.starts_with(name) && column[name.size()] == '.');
}

void require_series(const MatrixPlan& plan, const std::vector<std::string>& columns) {
  for (const Agreement& agreement : plan.agreements)
    for (const std::string& name : agreement.series) {
      if (std::ranges::any_of(columns, [&](const std::string& column) { return is_series(column, name); }))
        continue;
      const std::string guess = nearest_name(name, columns);
      throw Error(agreement.series_where,
                  fmt::format("matrix.agree.series: the run records no series '{}'.{} It records: {}", name,
                              guess.empty() ? "" : fmt::format(" Did you mean '{}'?", guess),
                              fmt::join(columns, ", ")));
    }
}

MatrixPlan plan_matrix(const std::filesystem::path& scene_file, const std::vector<std::string>& set) {
  const Scene scene = load(scene_file, set);
  MatrixPlan plan;
  plan.scene = scene_file;
  plan.tier = scene.root.text("tier");
  plan.checks = scene.root.list("checks").size();
  plan.steps = time_of(scene).steps;
  plan.middle = time_of(scene).middle;
  if (scene.root.has("matrix"))
    Planner(scene, set).plan(plan);
  else
    plan.variants.emplace_back();
  return plan;
}

}  // namespace seam::cli
