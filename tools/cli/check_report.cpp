// SPDX-License-Identifier: BSD-3-Clause
#include "check_report.hpp"

#include <fmt/ranges.h>

#include <sstream>
#include <utility>

#include "seam/record/series_units.hpp"

namespace seam::cli {
namespace {

std::string with_unit(const nlohmann::json& named) {
  const nlohmann::json& unit = named["unit"];
  std::string name = named["name"];
  if (unit.is_null()) return name;
  return fmt::format("{} [{}]", name, unit.get<std::string>().empty() ? "-" : unit.get<std::string>());
}

std::string list(const nlohmann::json& named) {
  std::vector<std::string> all;
  for (const auto& one : named) all.push_back(with_unit(one));
  return fmt::format("{}", fmt::join(all, ", "));
}

/// Takes a number behind a colon off the end of a place; null where there is none.
nlohmann::json take_number(std::string& place) {
  const std::size_t colon = place.find_last_not_of("0123456789");
  if (colon == std::string::npos || place[colon] != ':' || place.size() - colon > 9 ||
      colon + 1 == place.size())
    return {};
  const long number = std::stol(place.substr(colon + 1));
  place.erase(colon);
  return number;
}

/// "file:line:column: error: message"; null where a line is none of those.
nlohmann::json one_diagnostic(const std::string& line) {
  const auto position = [&](const std::string& severity) {
    return line.starts_with(severity + ": ") ? 0 : line.find(": " + severity + ": ");
  };
  const std::string severity = position("warning") < position("error") ? "warning" : "error";
  if (const std::size_t at = position(severity); at != std::string::npos) {
    const std::string mark = severity + ": ";
    std::string place = line.substr(0, at);
    nlohmann::json last = take_number(place), first = take_number(place);
    if (first.is_null()) std::swap(first, last);
    return {{"severity", severity},
            {"file", place.empty() ? nlohmann::json() : nlohmann::json(place)},
            {"line", first},
            {"column", last},
            {"message", line.substr(at + mark.size() + (at > 0 ? 2 : 0))}};
  }
  return {};
}

}  // namespace

nlohmann::json describe_contents(const Registry& registry, Session& session) {
  nlohmann::json contents;
  contents["fields"] = nlohmann::json::array();
  for (const FieldEntry& entry : session.problem().fields()) {
    const MeshData& mesh = entry.mesh->whole();
    auto unknowns = nlohmann::json::array();
    for (const Unknown& unknown : entry.field->unknowns())
      unknowns.push_back(
          {{"name", unknown.name}, {"unit", unknown.unit}, {"components", unknown.components}});
    contents["fields"].push_back({{"name", entry.name},
                                  {"unknowns", unknowns},
                                  {"mesh",
                                   {{"name", entry.mesh->name()},
                                    {"cells", mesh.cell_count()},
                                    {"cell", seam::name(mesh.type)},
                                    {"order", mesh.order},
                                    {"nodes", mesh.node_count()}}}});
  }
  const std::vector<std::string> names = session.results().names();
  const auto units = series_units(session.scene(), registry, session.problem(), names);
  contents["recorded"] = nlohmann::json::array();
  for (const std::string& name : names) {
    const auto unit = units.find(name);
    contents["recorded"].push_back(
        {{"name", name}, {"unit", unit == units.end() ? nlohmann::json() : nlohmann::json(unit->second)}});
  }
  contents["unknowns"] = session.unknowns();
  const CostEstimate cost = session.estimate();
  contents["memory_bytes"] = cost.bytes;
  contents["seconds_per_step"] = cost.seconds_per_step;
  contents["includes_linear_solves"] = cost.has_linear;
  contents["linear_solver"] = session.linear_choice();
  return contents;
}

std::string contents_as_text(const nlohmann::json& contents) {
  std::string text;
  for (const auto& field : contents["fields"]) {
    const auto& mesh = field["mesh"];
    text += fmt::format("field {}: {}; mesh {} of {} {} cells of order {}, {} nodes\n",
                        field["name"].get<std::string>(), list(field["unknowns"]),
                        mesh["name"].get<std::string>(), mesh["cells"].get<long>(),
                        mesh["cell"].get<std::string>(), mesh["order"].get<int>(), mesh["nodes"].get<long>());
  }
  text += fmt::format("recorded at each step: {}\n", list(contents["recorded"]));
  const bool all = contents["includes_linear_solves"];
  text += fmt::format("{} unknowns; about {:.0f} MB and {:.2g} s a step, of {} iterations{}\n",
                      contents["unknowns"].get<long long>(), contents["memory_bytes"].get<double>() / 1e6,
                      contents["seconds_per_step"].get<double>(), CostEstimate::iterations,
                      all ? "" : ", without what the linear solver takes");
  if (const std::string choice = contents["linear_solver"]; !choice.empty())
    text += fmt::format("solved by {}\n", choice);
  return text;
}

nlohmann::json diagnostics_as_json(const std::string& messages) {
  auto all = nlohmann::json::array();
  std::istringstream lines(messages);
  for (std::string line; std::getline(lines, line);) {
    nlohmann::json found = one_diagnostic(line);
    if (!found.is_null()) {
      all.push_back(std::move(found));
      continue;
    }
    // It goes on with what was said before.
    if (all.empty()) all.push_back(one_diagnostic("error: "));
    const std::string before = all.back()["message"];
    all.back()["message"] = before.empty() ? line : before + "\n" + line;
  }
  return all;
}

}  // namespace seam::cli
