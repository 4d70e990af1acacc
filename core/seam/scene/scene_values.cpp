// SPDX-License-Identifier: BSD-3-Clause
#include "seam/scene/scene_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <string_view>

#include "seam/base/checksum.hpp"
#include "seam/scene/overrides.hpp"
#include "seam/scene/yaml_tree.hpp"

namespace seam {
namespace {

using Values = std::map<std::string, std::string>;

void flatten(const YamlNode& node, const std::string& path, Values& values) {
  const std::string start = path.empty() ? "" : path + ".";
  switch (node.kind) {
    case YamlNode::Kind::null:
      values[path] = "null";
      return;
    case YamlNode::Kind::scalar:
      values[path] = node.scalar;
      return;
    case YamlNode::Kind::sequence:
      if (node.items.empty()) values[path] = "[]";
      for (std::size_t i = 0; i < node.items.size(); ++i)
        flatten(node.items[i], start + std::to_string(i), values);
      return;
    case YamlNode::Kind::map:
      if (node.items.empty()) values[path] = "{}";
      for (std::size_t i = 0; i < node.items.size(); ++i)
        flatten(node.items[i], start + node.keys[i].scalar, values);
      return;
  }
}

/// Keys whose value is the name of a file that decides what is computed.
bool names_a_file(const std::string& path) { return path.ends_with(".file") || path == "time.step.replay"; }

/// Whether a value may change in a run that goes on without making it another simulation.
bool is_harmless(const std::string& path) {
  constexpr std::array<std::string_view, 17> harmless{"format",
                                                      "title",
                                                      "source",
                                                      "tier",
                                                      "checks",
                                                      "study",
                                                      "matrix",
                                                      "plugin_folders",
                                                      "output.folder",
                                                      "output.every",
                                                      "output.fields",
                                                      "output.cut",
                                                      "output.interfaces",
                                                      "output.picture",
                                                      "output.statistics",
                                                      "output.errors",
                                                      "output.restart"};
  return std::ranges::any_of(harmless, [&](std::string_view block) { return is_or_is_within(path, block); });
}

}  // namespace

std::string content_checksum(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return "";
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  return fmt::format("{:016x}", checksum(bytes));
}

bool is_or_is_within(std::string_view path, std::string_view block) {
  return path == block || (path.starts_with(block) && path[block.size()] == '.');
}

Values scene_values(const Scene& scene) {
  YamlNode root = parse_yaml(scene.text, scene.path.string());
  apply_overrides(root, scene.overrides);
  Values values;
  flatten(root, "", values);
  Values contents;
  for (const auto& [path, value] : values)
    if (names_a_file(path))
      contents[path + " (content)"] = content_checksum(scene.path.parent_path() / value);
  values.merge(contents);
  return values;
}

std::vector<std::string> scene_differences(const Values& before, const Values& now) {
  std::set<std::string> paths;
  for (const auto& [path, value] : before) paths.insert(path);
  for (const auto& [path, value] : now) paths.insert(path);
  const auto text = [](const Values& values, const std::string& path) {
    const auto found = values.find(path);
    return found == values.end() ? "not there" : found->second;
  };
  std::vector<std::string> result;
  for (const std::string& path : paths)
    if (!is_harmless(path) && text(before, path) != text(now, path))
      result.push_back(fmt::format("{}: {}, now {}", path, text(before, path), text(now, path)));
  return result;
}

}  // namespace seam
