// SPDX-License-Identifier: BSD-3-Clause
#include "seam/conformance/plugin_checks.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "seam/base/plugin_fault.hpp"
#include "seam/scene/explain.hpp"
#include "seam/scene/json_schema.hpp"
#include "seam/scene/validate.hpp"

namespace seam {
namespace {

/// Keys without a line of meaning, here and in all objects below.
void find_silent_keys(const Schema& schema, const std::string& path, std::vector<std::string>& silent) {
  for (const Parameter& p : schema.parameters()) {
    if (p.help.empty()) silent.push_back(path + p.name);
    if (p.sub) find_silent_keys(*p.sub, path + p.name + ".", silent);
  }
}

/// What validation says of an empty object, apart from the required keys that it lacks: errors in defaults.
void find_bad_defaults(const Schema& schema, const Registry& registry, int dimension, const std::string& path,
                       std::vector<std::string>& bad) {
  YamlNode empty;
  empty.kind = YamlNode::Kind::map;
  Diagnostics diagnostics;
  ValidationContext context{registry, diagnostics, dimension, {}, {}, false, {}, {}};
  validate(empty, schema, context, path);
  for (const Diagnostic& d : diagnostics.all())
    if (d.severity == Diagnostic::Severity::error && d.message.find("needs the key") == std::string::npos)
      bad.push_back(d.message);
  for (const Parameter& p : schema.parameters())
    if (p.sub) find_bad_defaults(*p.sub, registry, dimension, path + "." + p.name, bad);
}

/// What keys point to that does not exist: a thing of the scene that there is no kind of, a kind of types
/// that no plugin has.
void find_bad_targets(const Schema& schema, const std::set<std::string>& kinds, const std::string& path,
                      std::vector<std::string>& bad) {
  static const std::set<std::string> things{"mesh", "field", "interface"};
  static const std::set<std::string> parts{"boundary", "region"};
  for (const Parameter& p : schema.parameters()) {
    const std::string target = p.target.substr(0, p.target.find(':'));
    const std::string key = path + p.name;
    const bool is_typed =
        p.kind == ValueKind::typed || p.kind == ValueKind::typed_list || p.kind == ValueKind::typed_map;
    if (is_typed && !kinds.contains(target))
      bad.push_back(
          fmt::format("'{}' takes a '{}'; no plugin that is found has types of this kind", key, target));
    if (!is_typed && !target.empty() && !things.contains(target) && !parts.contains(target))
      bad.push_back(fmt::format("'{}' names a '{}'; there are {}, {}", key, target, fmt::join(things, ", "),
                                fmt::join(parts, ", ")));
    if (p.sub) find_bad_targets(*p.sub, kinds, key + ".", bad);
  }
}

ConformanceCheck check_schema(const Registry::Entry& entry, const Registry& registry,
                              const std::set<std::string>& kinds) {
  std::vector<std::string> problems;
  if (entry.schema.summary().empty()) problems.push_back("the type has no summary");
  std::vector<std::string> silent;
  find_silent_keys(entry.schema, "", silent);
  if (!silent.empty()) problems.push_back(fmt::format("keys without help: {}", fmt::join(silent, ", ")));
  for (const int dimension : {2, 3})
    find_bad_defaults(entry.schema, registry, dimension, entry.name, problems);
  find_bad_targets(entry.schema, kinds, "", problems);
  std::sort(problems.begin(), problems.end());
  problems.erase(std::unique(problems.begin(), problems.end()), problems.end());
  const std::string page = explain(entry, registry);
  for (const Parameter& p : entry.schema.parameters())
    if (page.find(p.name) == std::string::npos)
      problems.push_back(fmt::format("`seam explain` leaves out '{}'", p.name));
  return conformance_check(fmt::format("schema of {}:{}", entry.kind, entry.name), problems.empty(),
                           problems.empty() ? fmt::format("{} keys", entry.schema.parameters().size())
                                            : fmt::format("{}", fmt::join(problems, "\n")));
}

ConformanceCheck check_json_schema(const PluginInfo& plugin, const Registry& registry) {
  std::vector<std::string> missing;
  try {
    const std::string text = json_schema(scene_schema(), registry);
    if (!nlohmann::json::accept(text)) return conformance_check("JSON Schema", false, "it is not valid JSON");
    for (const auto& [kind, type] : plugin.provides)
      if (text.find('"' + type + '"') == std::string::npos) missing.push_back(type);
  } catch (const std::exception& error) {
    return conformance_check("JSON Schema", false, error.what());
  }
  return conformance_check("JSON Schema", missing.empty(),
                           missing.empty() ? "valid JSON with all its types"
                                           : fmt::format("does not know {}", fmt::join(missing, ", ")));
}

void visit_typed(const Schema& schema, const Parameters& values, const Registry& registry,
                 const std::function<void(const Registry::Entry&, const Parameters&)>& visit);

void visit_one(const std::string& kind, const Parameters& object, const Registry& registry,
               const std::function<void(const Registry::Entry&, const Parameters&)>& visit) {
  const Registry::Entry* entry = registry.find(kind, object.type());
  if (!entry) return;
  visit(*entry, object);
  visit_typed(entry->schema, object, registry, visit);
}

void visit_typed(const Schema& schema, const Parameters& values, const Registry& registry,
                 const std::function<void(const Registry::Entry&, const Parameters&)>& visit) {
  for (const Parameter& p : schema.parameters()) {
    if (!values.has(p.name)) continue;
    switch (p.kind) {
      case ValueKind::object:
        visit_typed(*p.sub, values.object(p.name), registry, visit);
        break;
      case ValueKind::list:
        for (const Parameters& item : values.list(p.name)) visit_typed(*p.sub, item, registry, visit);
        break;
      case ValueKind::map:
        for (const auto& item : values.map(p.name)) visit_typed(*p.sub, item.second, registry, visit);
        break;
      case ValueKind::typed:
        visit_one(p.target, values.object(p.name), registry, visit);
        break;
      case ValueKind::typed_list:
        for (const Parameters& item : values.list(p.name)) visit_one(p.target, item, registry, visit);
        break;
      case ValueKind::typed_map:
        for (const auto& item : values.map(p.name)) visit_one(p.target, item.second, registry, visit);
        break;
      default:
        break;
    }
  }
}

}  // namespace

std::vector<ConformanceCheck> check_plugin(const PluginHost::Found& plugin, PluginHost& host,
                                           Registry& registry) {
  std::vector<ConformanceCheck> checks;
  const std::string problem = plugin.why_not();
  checks.push_back(conformance_check(
      "descriptor", problem.empty(),
      problem.empty()
          ? fmt::format("plugin ABI {}.{}, built as this Seam", plugin.info.abi_major, plugin.info.abi_minor)
          : problem));
  if (!problem.empty()) return checks;
  try {
    std::vector<std::string> together = plugin.info.required_plugins;
    together.push_back(plugin.name);
    host.load(together, registry);
  } catch (...) {
    checks.push_back(conformance_check("registration", false, text_of_exception()));
    return checks;
  }
  checks.push_back(conformance_check(
      "registration", true,
      fmt::format("registers the {} types it declares, no others", plugin.info.provides.size())));
  std::set<std::string> kinds;
  for (const Registry::Entry& entry : registry.entries()) kinds.insert(entry.kind);
  for (const PluginHost::Found& other : host.scan())
    for (const auto& [kind, type] : other.info.provides) kinds.insert(kind);
  for (const Registry::Entry& entry : registry.entries())
    if (entry.plugin == plugin.name) checks.push_back(check_schema(entry, registry, kinds));
  checks.push_back(check_json_schema(plugin.info, registry));
  return checks;
}

void for_each_typed(const Scene& scene, const Registry& registry,
                    const std::function<void(const Registry::Entry&, const Parameters&)>& visit) {
  static const Schema schema = scene_schema();
  visit_typed(schema, scene.root, registry, visit);
}

std::vector<ConformanceCheck> check_coverage(const PluginInfo& plugin, const std::set<std::string>& used) {
  std::vector<ConformanceCheck> checks;
  for (const auto& [kind, type] : plugin.provides) {
    const std::string name = kind + ":" + type;
    checks.push_back(
        conformance_check("used by a scene: " + name, used.contains(name),
                          used.contains(name) ? "" : "no scene tests it; write one, or give one by --scene"));
  }
  return checks;
}

}  // namespace seam
