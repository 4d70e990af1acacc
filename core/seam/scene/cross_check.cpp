// SPDX-License-Identifier: BSD-3-Clause
#include "seam/scene/cross_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "seam/plugin/plugin_host.hpp"

namespace seam {

namespace {

using Map = Parameters::Value::Map;

Map entries(const Parameters& root, const std::string& key) { return root.has(key) ? root.map(key) : Map{}; }

std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> result;
  for (const auto& entry : map) result.push_back(entry.first);
  return result;
}

std::string hint(const std::string& name, const std::vector<std::string>& known) {
  const std::string guess = nearest_name(name, known);
  return guess.empty() ? "" : fmt::format(" Did you mean '{}'?", guess);
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 30;
  if (names.size() <= shown) return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{}, ... ({} in all)", fmt::join(names.begin(), names.begin() + shown, ", "),
                     names.size());
}

/// The block of the scene that defines what a reference names, or "" when that is not the scene's.
std::string block_of(const std::string& target) {
  if (target == "mesh") return "meshes";
  if (target == "field") return "fields";
  if (target == "interface") return "interfaces";
  return "";
}

/// A coupling, say, on an interface that it has nothing to do with.
void check_types(const Scene& scene, const Registry& registry, const std::vector<NamedPlace>& places,
                 Diagnostics& diagnostics) {
  for (const NamedPlace& place : places)
    for (const auto& [name, values] : entries(scene.root, block_of(place.target))) {
      if (name != place.name || place.types.empty()) continue;
      const Registry::Entry* entry = registry.find(place.target, values.type());
      const bool fits = std::find(place.types.begin(), place.types.end(), values.type()) != place.types.end();
      if (fits || !entry || entry->plugin != "core") continue;
      diagnostics.error(place.where,
                        fmt::format("{}: the {} '{}' ({}) is of type '{}'; what stands here takes {}",
                                    place.path, place.target, name, values.where().text(), values.type(),
                                    fmt::join(place.types, ", ")));
    }
}

void check_references(const Scene& scene, const std::vector<NamedPlace>& places, Diagnostics& diagnostics) {
  std::map<std::string, std::vector<std::string>> defined;  // by block
  std::set<std::string> keys;                               // block and name
  for (const std::string block : {"meshes", "fields", "interfaces"}) {
    if (!scene.root.has(block)) continue;
    defined[block] = names_of(scene.root.map(block));
    for (const std::string& name : defined[block]) keys.insert(block + "." + name);
  }
  for (const NamedPlace& place : places) {
    const std::string block = block_of(place.target);
    if (defined.count(block) == 0 || keys.count(block + "." + place.name) > 0) continue;
    diagnostics.error(place.where,
                      fmt::format("{}: there is no {} '{}' in `{}` ({}).{} Known: {}", place.path,
                                  place.target, place.name, block, scene.root.where(block).text(),
                                  hint(place.name, defined[block]), listed(defined[block])));
  }
}

void warn_unused(const Scene& scene, const std::vector<NamedPlace>& places, Diagnostics& diagnostics) {
  std::set<std::string> used;
  for (const NamedPlace& place : places)
    // A probe on an interface makes nothing happen there.
    if (place.target != "interface" || place.path.starts_with("coupling"))
      used.insert(place.target + " " + place.name);
  for (const auto& [name, values] : entries(scene.root, "interfaces")) {
    if (used.count("interface " + name) > 0) continue;
    diagnostics.warning(values.where(),
                        fmt::format("no coupling uses the interface '{}': nothing happens there", name));
  }
  for (const auto& [name, values] : entries(scene.root, "meshes")) {
    if (used.count("mesh " + name) > 0) continue;
    diagnostics.warning(values.where(), fmt::format("no field uses the mesh '{}'", name));
  }
}

void warn_unused_plugins(const Scene& scene, const std::vector<PluginHost::Found>& loaded,
                         std::set<std::string> used, Diagnostics& diagnostics) {
  for (std::size_t known = 0; known != used.size();) {
    known = used.size();
    for (const PluginHost::Found& plugin : loaded) {
      if (used.count(plugin.name) > 0)
        used.insert(plugin.info.required_plugins.begin(), plugin.info.required_plugins.end());
    }
  }
  for (const std::string& name : scene.plugins) {
    if (used.count(name) > 0) continue;
    diagnostics.warning(scene.root.where("plugins"),
                        fmt::format("plugin '{}' is loaded, but the scene uses none of its types", name));
  }
}

/// The same coupling twice on one interface would count every condition double.
void check_couplings(const Scene& scene, Diagnostics& diagnostics) {
  if (!scene.root.has("coupling")) return;
  std::map<std::string, Location> first;
  for (const Parameters& coupling : scene.root.list("coupling")) {
    std::string on;
    try {
      on = coupling.has("on") ? coupling.text("on") : "";
    } catch (const std::logic_error&) {
      continue;  // a coupling whose `on` is no single interface is its own plugin's to judge
    }
    const auto [it, is_new] = first.emplace(coupling.type() + " on " + on, coupling.where());
    if (is_new || on.empty()) continue;
    diagnostics.error(coupling.where(),
                      fmt::format("a second coupling {} (the first is at {}): its conditions would count "
                                  "twice; remove one of them",
                                  it->first, it->second.text()));
  }
}

bool is_tolerance(std::string text) {
  if (!text.empty() && text.back() == '%') text.pop_back();
  while (!text.empty() && text.back() == ' ') text.pop_back();
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc{} && end == text.data() + text.size() && value >= 0 && value < 1e300;
}

void check_checks(const Scene& scene, Diagnostics& diagnostics) {
  if (!scene.root.has("checks")) return;
  for (const Parameters& check : scene.root.list("checks")) {
    const std::string name = check.has("that") ? check.text("that") : "";
    if (check.has("within") && !is_tolerance(check.text("within"))) {
      diagnostics.error(check.where("within"),
                        fmt::format("check '{}': found '{}', expected a deviation such as 0.1% or 1e-3", name,
                                    check.text("within")));
    }
    if (check.has("is") != check.has("within")) {
      diagnostics.error(
          check.where(),
          fmt::format("check '{}' gives '{}' without '{}'; a value and its allowed deviation go "
                      "together",
                      name, check.has("is") ? "is" : "within", check.has("is") ? "within" : "is"));
    }
    if (!check.has("is") && !check.has("within") && !check.has("at_least") && !check.has("at_most")) {
      diagnostics.error(check.where(),
                        fmt::format("check '{}' says nothing; give 'is' with 'within', 'at_least' or "
                                    "'at_most'",
                                    name));
    }
  }
}

/// Each joint lets a body follow another one: there has to be a first.
void check_joints(const Scene& scene, Diagnostics& diagnostics) {
  if (!scene.root.has("constraints")) return;
  std::map<std::string, std::string> holder;
  for (const Parameters& joint : scene.root.list("constraints")) {
    if (joint.type() != "joint" || !joint.has("body") || !joint.has("to") || joint.has("on")) continue;
    const std::string body = joint.text("body");
    if (!holder.emplace(body, joint.text("to")).second) continue;  // a second joint, told elsewhere
    std::string loop = fmt::format("'{}' is held to", body), at = joint.text("to");
    while (at != body && holder.contains(at)) {
      loop += fmt::format(" '{}', which is held to", at);
      at = holder.at(at);
    }
    if (at == body)
      diagnostics.error(
          joint.where(),
          fmt::format("{} '{}': joints cannot form a loop; close it by a `spring` on a `link`", loop, body));
  }
}

void check_probes(const Scene& scene, Diagnostics& diagnostics) {
  if (!scene.root.has("output") || !scene.root.object("output").has("probes")) return;
  for (const auto& [name, probe] : scene.root.object("output").map("probes")) {
    if (probe.has("at") && probe.has("on")) {
      diagnostics.error(
          probe.where(),
          fmt::format("probe '{}' gives both a point ('at') and boundaries ('on'); remove one", name));
    }
  }
}

void check_time(const Scene& scene, Diagnostics& diagnostics) {
  if (!scene.root.has("time")) return;
  const Parameters& time = scene.root.object("time");
  if (time.has("start") && time.has("end") && time.number("end") <= time.number("start")) {
    diagnostics.error(time.where("end"), fmt::format("time.end: {} is not after time.start, which is {}",
                                                     time.number("end"), time.number("start")));
  }
  if (!time.has("step")) return;
  const Parameters& step = time.object("step");
  if (step.has("minimum") && step.has("maximum") && step.number("minimum") > step.number("maximum")) {
    diagnostics.error(step.where("minimum"), fmt::format("time.step: the minimum {} is above the maximum {}",
                                                         step.number("minimum"), step.number("maximum")));
  }
}

}  // namespace

void cross_check(const Scene& scene, const Registry& registry, const std::vector<PluginHost::Found>& loaded,
                 const std::set<std::string>& used_plugins, Diagnostics& diagnostics) {
  const std::vector<NamedPlace> places = named_places(scene.root, registry);
  // What hangs on an entry in error would be reported a second time.
  const bool complete = !diagnostics.has_errors();
  check_couplings(scene, diagnostics);
  check_checks(scene, diagnostics);
  check_joints(scene, diagnostics);
  check_probes(scene, diagnostics);
  check_time(scene, diagnostics);
  if (!complete) return;
  check_references(scene, places, diagnostics);
  check_types(scene, registry, places, diagnostics);
  warn_unused(scene, places, diagnostics);
  warn_unused_plugins(scene, loaded, used_plugins, diagnostics);
}

void check_mesh_names(const Scene& scene, const Registry& registry,
                      const std::map<std::string, MeshNames>& meshes) {
  Diagnostics diagnostics;
  std::map<std::string, Location> defined;
  for (const auto& [name, values] : entries(scene.root, "meshes")) defined[name] = values.where();
  for (const NamedPlace& place : named_places(scene.root, registry)) {
    const auto mesh = meshes.find(place.mesh);
    if ((place.target != "boundary" && place.target != "region") || mesh == meshes.end()) continue;
    const std::set<std::string>& known =
        place.target == "boundary" ? mesh->second.boundaries : mesh->second.regions;
    if (known.count(place.name) > 0) continue;
    const std::vector<std::string> names(known.begin(), known.end());
    diagnostics.error(place.where,
                      fmt::format("{}: the mesh '{}' ({}) has no {} '{}'.{} It has: {}", place.path,
                                  place.mesh, defined[place.mesh].text(), place.target, place.name,
                                  hint(place.name, names), listed(names)));
  }
  diagnostics.throw_if_errors();
}

}  // namespace seam
