// SPDX-License-Identifier: BSD-3-Clause
#include "coverage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace seam::cli {
namespace {

const std::string scene_label = "scene";

std::string type_name(const std::string& kind, const std::string& name) { return kind + ":" + name; }

/// Words that a key holds: names of fields, say.
std::vector<std::string> words(const Parameters& values, const Parameter& key) {
  if (!values.has(key.name)) return {};
  return key.kind == ValueKind::names ? values.names(key.name) : std::vector{values.text(key.name)};
}

/// Fields that an object names, in itself and in what it holds.
void find_fields(const Parameters& values, const Schema& schema, std::set<std::string>& fields) {
  for (const Parameter& key : schema.parameters()) {
    const bool names_field =
        (key.kind == ValueKind::reference || key.kind == ValueKind::names) && key.target == "field";
    if (names_field)
      for (const std::string& name : words(values, key)) fields.insert(name);
    if (!values.has(key.name) || !key.sub) continue;
    if (key.kind == ValueKind::object) find_fields(values.object(key.name), *key.sub, fields);
    if (key.kind == ValueKind::list)
      for (const Parameters& item : values.list(key.name)) find_fields(item, *key.sub, fields);
  }
}

}  // namespace

void Coverage::enumerate(const Schema& schema, const std::string& label) {
  for (const Parameter& key : schema.parameters()) {
    const std::string own = label + "." + key.name;
    if (key.kind == ValueKind::choice)
      for (const std::string& value : key.choices) choices_[own].try_emplace(value, 0);
    if (key.sub) enumerate(*key.sub, own);
  }
}

void Coverage::add(const Scene& scene, const Registry& registry) {
  const Schema schema = scene_schema();
  if (choices_.empty()) enumerate(schema, scene_label);
  for (const Registry::Entry& entry : registry.entries()) {
    const std::string name = type_name(entry.kind, entry.name);
    if (types_.try_emplace(name, Type{entry.plugin, 0}).second) enumerate(entry.schema, name);
  }
  used_.clear();
  walk(scene.root, schema, scene_label, registry);
  for (const std::string& used : used_)
    if (const auto type = types_.find(used); type != types_.end()) ++type->second.scenes;
  for (auto& [key, values] : choices_)
    for (auto& [value, scenes] : values)
      if (used_.contains(key + "=" + value)) ++scenes;
  meet_fields(scene, registry);
}

void Coverage::walk_typed(const Parameters& values, const std::string& kind, const Registry& registry) {
  const std::string name = type_name(kind, values.type());
  used_.insert(name);
  walk(values, registry.find(kind, values.type())->schema, name, registry);
}

void Coverage::walk(const Parameters& values, const Schema& schema, const std::string& label,
                    const Registry& registry) {
  for (const Parameter& key : schema.parameters()) {
    if (!values.has(key.name)) continue;
    const std::string own = label + "." + key.name;
    switch (key.kind) {
      case ValueKind::choice:
        used_.insert(own + "=" + values.text(key.name));
        break;
      case ValueKind::object:
        walk(values.object(key.name), *key.sub, own, registry);
        break;
      case ValueKind::list:
        for (const Parameters& item : values.list(key.name)) walk(item, *key.sub, own, registry);
        break;
      case ValueKind::map:
        for (const auto& entry : values.map(key.name)) walk(entry.second, *key.sub, own, registry);
        break;
      case ValueKind::typed:
        walk_typed(values.object(key.name), key.target, registry);
        break;
      case ValueKind::typed_list:
        for (const Parameters& item : values.list(key.name)) walk_typed(item, key.target, registry);
        break;
      case ValueKind::typed_map:
        for (const auto& entry : values.map(key.name)) walk_typed(entry.second, key.target, registry);
        break;
      default:
        break;
    }
  }
}

void Coverage::meet_fields(const Scene& scene, const Registry& registry) {
  std::map<std::string, std::string> types;
  for (const auto& [name, field] : scene.root.map("fields")) types[name] = field.type();
  std::map<std::string, std::set<std::string>> of_interfaces;
  for (const auto& [name, interface] : scene.root.map("interfaces"))
    find_fields(interface, registry.find("interface", interface.type())->schema, of_interfaces[name]);
  for (const Parameters& coupling : scene.root.list("coupling")) {
    const Schema& schema = registry.find("coupling", coupling.type())->schema;
    std::set<std::string> fields;
    find_fields(coupling, schema, fields);
    for (const Parameter& key : schema.parameters())
      if (key.target == "interface")
        for (const std::string& name : words(coupling, key))
          fields.insert(of_interfaces[name].begin(), of_interfaces[name].end());
    for (const std::string& field : fields)
      if (const auto type = types.find(field); type != types.end())
        fields_of_couplings_[coupling.type()].insert(type->second);
  }
}

std::vector<std::string> Coverage::unused_types(const std::set<std::string>& plugins) const {
  std::vector<std::string> unused;
  for (const auto& [name, type] : types_)
    if (type.scenes == 0 && plugins.contains(type.plugin)) unused.push_back(name);
  return unused;
}

std::set<std::string> Coverage::plugins() const {
  std::set<std::string> all;
  for (const auto& entry : types_) all.insert(entry.second.plugin);
  return all;
}

std::string Coverage::as_markdown() const {
  const auto used = std::ranges::count_if(types_, [](const auto& entry) { return entry.second.scenes > 0; });
  std::string text = fmt::format("# Coverage\n\n{} of {} registered types are used.\n", used, types_.size());
  if (const std::vector<std::string> unused = unused_types(plugins()); !unused.empty()) {
    text += "\n| type that no variant uses | plugin |\n|---|---|\n";
    for (const std::string& name : unused) text += fmt::format("| {} | {} |\n", name, types_.at(name).plugin);
  }
  text += "\n| key | values that no variant has |\n|---|---|\n";
  const auto says_nothing_of_the_run = [](const std::string& key) {
    return std::ranges::any_of(
        std::vector<std::string>{"scene.tier", "scene.matrix.", "scene.checks.", "scene.output.picture."},
        [&](const std::string& start) { return key.starts_with(start); });
  };
  for (const auto& [key, values] : choices_) {
    if (says_nothing_of_the_run(key)) continue;
    // Keys of a type that nobody uses are told by the type.
    if (const auto type = types_.find(key.substr(0, key.find('.')));
        type != types_.end() && type->second.scenes == 0)
      continue;
    std::vector<std::string> missing;
    for (const auto& [value, scenes] : values)
      if (scenes == 0) missing.push_back(value);
    if (!missing.empty()) text += fmt::format("| {} | {} |\n", key, fmt::join(missing, ", "));
  }
  std::set<std::string> fields;
  for (const auto& entry : types_)
    if (entry.first.starts_with("field:")) fields.insert(entry.first.substr(entry.first.find(':') + 1));
  text += "\n| coupling | meets | not |\n|---|---|---|\n";
  for (const auto& [coupling, met] : fields_of_couplings_) {
    std::vector<std::string> others;
    std::ranges::set_difference(fields, met, std::back_inserter(others));
    text += fmt::format("| {} | {} | {} |\n", coupling, fmt::join(met, ", "), fmt::join(others, ", "));
  }
  return text;
}

}  // namespace seam::cli
