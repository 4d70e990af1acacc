// SPDX-License-Identifier: BSD-3-Clause
#include "seam/plugin/registry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace seam {

Registry::Registry() = default;
Registry::Registry(const Registry&) = default;
Registry::Registry(Registry&&) noexcept = default;
Registry& Registry::operator=(const Registry&) = default;
Registry& Registry::operator=(Registry&&) noexcept = default;
Registry::~Registry() = default;

const Registry::Entry* Registry::find(const std::string& kind, const std::string& name) const {
  const auto it = std::find_if(entries_.begin(), entries_.end(),
                               [&](const Entry& e) { return e.kind == kind && e.name == name; });
  return it == entries_.end() ? nullptr : &*it;
}

std::vector<std::string> Registry::names(const std::string& kind) const {
  std::vector<std::string> result;
  for (const Entry& entry : entries_) {
    if (entry.kind == kind) result.push_back(entry.name);
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::string Registry::describe(const Entry& entry) {
  return fmt::format("{} '{}'{}", entry.kind, entry.name,
                     entry.plugin == "core" ? "" : fmt::format(" of plugin '{}'", entry.plugin));
}

void Registry::publishes(const std::string& kind, const std::string& name, std::vector<Published> what) {
  if (!find(kind, name))
    throw Error(fmt::format("plugin '{}' says what {} '{}' publishes before it has registered it",
                            current_plugin_, kind, name));
  published_[{kind, name}] = std::move(what);
}

const std::vector<Published>& Registry::published(const std::string& kind, const std::string& name) const {
  static const std::vector<Published> nothing;
  const auto found = published_.find({kind, name});
  return found == published_.end() ? nothing : found->second;
}

void Registry::remove_plugin(const std::string& name) {
  for (const Entry& entry : entries_)
    if (entry.plugin == name) published_.erase({entry.kind, entry.name});
  std::erase_if(entries_, [&](const Entry& e) { return e.plugin == name; });
}

void Registry::insert(Entry entry) {
  if (const Entry* other = find(entry.kind, entry.name)) {
    throw Error(fmt::format(
        "{} '{}' is registered by plugin '{}' and by plugin '{}'; a scene can load only one of them",
        entry.kind, entry.name, other->plugin, entry.plugin));
  }
  if (entry.kind.empty() || entry.name.empty()) {
    throw Error(fmt::format("plugin '{}' registers a type without {}", entry.plugin,
                            entry.kind.empty() ? "kind" : "name"));
  }
  if (entry.schema.find("type")) {
    throw Error(fmt::format("{} '{}' declares a key 'type', which selects the type and cannot be a parameter",
                            entry.kind, entry.name));
  }
  entries_.push_back(std::move(entry));
}

const Registry::Entry& Registry::require(const std::string& kind, const std::string& name,
                                         std::type_index interface, const Location& where) const {
  const Entry* entry = find(kind, name);
  if (!entry) {
    throw Error(where,
                fmt::format("no {} is called '{}'; known: {}", kind, name, fmt::join(names(kind), ", ")));
  }
  if (entry->interface != interface) {
    throw Error(
        where,
        fmt::format("{} '{}' of plugin '{}' implements {}, expected {}; the plugin was written against "
                    "another version of this interface",
                    kind, name, entry->plugin, entry->interface.name(), interface.name()));
  }
  return *entry;
}

}  // namespace seam
