// SPDX-License-Identifier: BSD-3-Clause
#include "seam/scene/explain.hpp"

#include <fmt/format.h>

#include <map>

#include "seam/scene/validate.hpp"

namespace seam {

namespace {

void write(const Schema& schema, int depth, std::string& out) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  for (const Parameter& p : schema.parameters()) {
    const std::string range = describe_range(p);
    out += fmt::format("{}{}: {}{}{}{}\n", indent, p.name, describe(p), range.empty() ? "" : ", " + range,
                       p.unit_text.empty() ? "" : fmt::format(" [{}]", p.unit_text),
                       p.required               ? ""
                       : p.default_text.empty() ? " (optional)"
                                                : fmt::format(" (default {})", p.default_text));
    out += fmt::format("{}    {}\n", indent, p.help);
    if (p.sub && !p.bare_values) write(*p.sub, depth + 1, out);
  }
}

void write(const std::vector<Published>& published, Published::As as, const std::string& heading,
           std::string& out) {
  bool is_first = true;
  for (const Published& p : published) {
    if (p.as != as) continue;
    if (is_first) out += "\n" + heading + "\n";
    is_first = false;
    out += fmt::format("  {}{}: {}\n", p.name, p.unit.empty() ? "" : fmt::format(" [{}]", p.unit), p.help);
  }
}

}  // namespace

std::string explain(const Schema& schema) {
  std::string result = schema.summary() + "\n\n";
  write(schema, 0, result);
  return result;
}

std::string explain(const Registry::Entry& entry, const Registry& registry) {
  std::string result = fmt::format("{} '{}' (plugin {})\n{}\n\n", entry.kind, entry.name, entry.plugin,
                                   entry.schema.summary());
  write(entry.schema, 0, result);
  const std::vector<Published>& published = registry.published(entry.kind, entry.name);
  write(published, Published::As::quantity, "Quantities, for probes and pictures:", result);
  write(published, Published::As::series,
        fmt::format("Series, recorded at every step by the name of the {}, a dot, and",
                    entry.kind == "coupling" ? "interface" : entry.kind),
        result);
  return result;
}

std::string list_types(const Registry& registry) {
  std::map<std::string, std::map<std::string, const Registry::Entry*>> kinds;
  for (const Registry::Entry& entry : registry.entries()) kinds[entry.kind][entry.name] = &entry;
  std::string result;
  for (const auto& [kind, types] : kinds) {
    result += kind + "\n";
    for (const auto& [name, entry] : types) {
      result += fmt::format("  {:<24} {} ({})\n", name, entry->schema.summary(), entry->plugin);
    }
  }
  return result;
}

}  // namespace seam
