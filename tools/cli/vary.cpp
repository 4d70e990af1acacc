// SPDX-License-Identifier: BSD-3-Clause
#include "vary.hpp"

#include <fmt/ranges.h>

#include <algorithm>

namespace seam::cli {
namespace {

constexpr std::size_t most_combinations = 10000;
const std::string parameters_prefix = "parameters.";

/// The key path of a name in `vary`, where a parameter may be called by its name alone.
/// @throws Error for a parameter that the scene does not have: overriding it would make it, and change
/// nothing
std::string key_path(const std::string& name, const Scene& scene, const Location& where,
                     const std::string& block) {
  const bool is_prefixed = name.starts_with(parameters_prefix);
  if (!is_prefixed && name.find('.') != std::string::npos) return name;
  const std::string parameter = is_prefixed ? name.substr(parameters_prefix.size()) : name;
  if (scene.parameters.contains(parameter)) return parameters_prefix + parameter;
  std::vector<std::string> known;
  for (const auto& entry : scene.parameters) known.push_back(entry.first);
  const std::string guess = nearest_name(parameter, known);
  throw Error(where, fmt::format("{}.vary: the scene has no parameter '{}'.{} It has: {}", block, parameter,
                                 guess.empty() ? "" : fmt::format(" Did you mean '{}'?", guess),
                                 known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
}

/// Groups of keys that change together, in the order of `vary`.
std::vector<std::vector<std::size_t>> groups_of(const Parameters& block, const std::string& name,
                                                const Vary& vary) {
  std::vector<bool> is_together(vary.keys.size(), false);
  std::vector<std::size_t> together;
  for (const std::string& word : block.names("together")) {
    const std::size_t key = find_key(vary, word, block.where("together"), name + ".together");
    if (!is_together[key]) together.push_back(key);
    is_together[key] = true;
  }
  const auto count = [&](std::size_t key) { return vary.keys[key].values.size(); };
  for (const std::size_t key : together)
    if (count(key) != count(together.front()))
      throw Error(block.where("together"),
                  fmt::format("{}.together: '{}' has {} values and '{}' has {}; expected as many of each",
                              name, vary.keys[together.front()].label, count(together.front()),
                              vary.keys[key].label, count(key)));
  std::vector<std::vector<std::size_t>> result;
  bool placed = false;
  for (std::size_t key = 0; key < vary.keys.size(); ++key) {
    if (!is_together[key]) {
      result.push_back({key});
    } else if (!placed) {
      result.push_back(together);
      placed = true;
    }
  }
  return result;
}

}  // namespace

std::size_t find_key(const Vary& vary, const std::string& name, const Location& where,
                     const std::string& what) {
  std::vector<std::string> known;
  for (const Vary::Key& key : vary.keys) known.push_back(key.label);
  const auto found = std::ranges::find_if(
      vary.keys, [&](const Vary::Key& key) { return key.label == name || key.path == name; });
  if (found == vary.keys.end())
    throw Error(where,
                fmt::format("{}: '{}' is no key of `vary`. Known: {}", what, name, fmt::join(known, ", ")));
  return static_cast<std::size_t>(found - vary.keys.begin());
}

Vary read_vary(const Parameters& block, const std::string& name, const Scene& scene,
               const std::function<bool(const std::string&)>& is_own) {
  const Parameters::Value::Map& map = block.map("vary");
  if (map.empty())
    throw Error(block.where("vary"), name + ".vary: expected at least one key with its values");
  Vary vary;
  for (const auto& [word, values] : map) {
    Vary::Key key;
    key.path = is_own && is_own(word) ? word : key_path(word, scene, values.where(), name);
    key.label =
        key.path.starts_with(parameters_prefix) ? key.path.substr(parameters_prefix.size()) : key.path;
    key.values = values.names("values");
    key.where = values.where();
    for (const Vary::Key& other : vary.keys)
      if (other.path == key.path)
        throw Error(key.where, fmt::format("{}.vary.{}: the key stands there twice, also as '{}'", name, word,
                                           other.label));
    if (key.values.empty()) throw Error(key.where, fmt::format("{}.vary.{}: no values", name, word));
    vary.keys.push_back(std::move(key));
  }
  vary.groups = groups_of(block, name, vary);
  return vary;
}

std::vector<std::vector<std::string>> combinations(const Vary& vary, const Location& where) {
  std::vector<std::vector<std::string>> all{std::vector<std::string>(vary.keys.size())};
  for (const std::vector<std::size_t>& group : vary.groups) {
    std::vector<std::vector<std::string>> longer;
    for (const std::vector<std::string>& one : all)
      for (std::size_t i = 0; i < vary.keys[group.front()].values.size(); ++i) {
        longer.push_back(one);
        for (const std::size_t key : group) longer.back()[key] = vary.keys[key].values[i];
        if (longer.size() > most_combinations)
          throw Error(where, fmt::format("vary: more than {} combinations", most_combinations));
      }
    all = std::move(longer);
  }
  return all;
}

}  // namespace seam::cli
