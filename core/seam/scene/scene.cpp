// SPDX-License-Identifier: BSD-3-Clause
#include "seam/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>

#include "seam/base/policy.hpp"
#include "seam/plugin/plugin_host.hpp"
#include "seam/scene/cross_check.hpp"
#include "seam/scene/overrides.hpp"
#include "seam/scene/validate.hpp"
#include "seam/scene/yaml_tree.hpp"

namespace seam {

namespace {

using Kind = YamlNode::Kind;

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> result(1);
  for (const char c : path) {
    if (c == '.') {
      result.emplace_back();
    } else {
      result.back() += c;
    }
  }
  return result;
}

/// The child that one word of a key path names; made when it is a new key of a map.
YamlNode& child(YamlNode& node, const std::string& key, const Location& where, const std::string& path) {
  if (node.kind == Kind::sequence) {
    std::size_t index = 0;
    const auto [end, code] = std::from_chars(key.data(), key.data() + key.size(), index);
    if (code == std::errc{} && end == key.data() + key.size() && index < node.items.size())
      return node.items[index];
    throw Error(where, fmt::format("'{}' of the key path '{}' is no entry of {}; count from 0", key, path,
                                   node.found()));
  }
  if (node.kind == Kind::scalar) {
    throw Error(where,
                fmt::format("the key path '{}' leads through {}, which has no keys", path, node.found()));
  }
  node.kind = Kind::map;
  if (YamlNode* existing = node.find(key)) return *existing;
  YamlNode word;
  word.kind = Kind::scalar;
  word.scalar = key;
  word.file = std::make_shared<const std::string>(where.file);
  node.keys.push_back(word);
  YamlNode& made = node.items.emplace_back();
  made.file = word.file;
  return made;
}

/// What a replaced value is told by is the option, not a line in it.
YamlNode without_lines(YamlNode node) {
  node.line = node.column = 0;
  for (auto* list : {&node.keys, &node.items})
    for (YamlNode& child_node : *list) child_node = without_lines(std::move(child_node));
  return node;
}

/// A parameter that the scene does not have would be made, and change nothing.
void require_parameter(const YamlNode& root, const std::vector<std::string>& keys, const Location& where) {
  if (keys.size() != 2 || keys[0] != "parameters") return;
  const YamlNode* parameters = root.find("parameters");
  if (parameters && parameters->find(keys[1])) return;
  std::vector<std::string> known;
  if (parameters)
    for (const YamlNode& key : parameters->keys) known.push_back(key.scalar);
  const std::string guess = nearest_name(keys[1], known);
  throw Error(where, fmt::format("the scene has no parameter '{}'.{} It has: {}", keys[1],
                                 guess.empty() ? "" : fmt::format(" Did you mean '{}'?", guess),
                                 known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
}

void apply(YamlNode& root, const std::string& path, const std::string& text) {
  const Location where{on_one_line(fmt::format("--set {}={}", path, text)), 0, 0};
  const std::vector<std::string> keys = split(path);
  constexpr std::size_t deepest = 20;
  if (keys.size() > deepest) throw Error(where, "the key path is too long");
  require_parameter(root, keys, where);
  YamlNode* node = &root;
  for (const std::string& key : keys) {
    if (key.empty()) throw Error(where, "expected key.key=value, with no empty key");
    node = &child(*node, key, where, path);
  }
  *node = without_lines(parse_yaml(text, where.file, {.bytes = 1 << 16, .nodes = 1000, .depth = 8}));
}

/// Words of a list (or one word), before the schema has been checked; anything else is left to the
/// validation.
std::vector<std::string> early_words(const YamlNode& root, const std::string& key) {
  std::vector<std::string> result;
  const YamlNode* node = root.find(key);
  if (!node) return result;
  if (node->kind == Kind::scalar) result.push_back(node->scalar);
  for (const YamlNode& item : node->items) {
    if (node->kind == Kind::sequence && item.kind == Kind::scalar) result.push_back(item.scalar);
  }
  std::erase(result, "");
  return result;
}

/// A newer format has keys and types that nobody here knows: that is said before anything else.
void refuse_newer_format(const YamlNode& root) {
  const YamlNode* node = root.find("format");
  if (!node || node->kind != Kind::scalar) return;
  long format = 0;
  const char* last = node->scalar.data() + node->scalar.size();
  const auto [end, code] = std::from_chars(node->scalar.data(), last, format);
  if (code != std::errc{} || end != last || format <= scene_format) return;
  throw Error(node->where(), fmt::format("format: found {}, this Seam reads scenes of format {}; use a newer "
                                         "Seam, or write the scene in the format of this one",
                                         format, scene_format));
}

/// The dimension decides how many entries vectors have, so it is needed before the rest is checked.
int early_dimension(const YamlNode& root) {
  const YamlNode* node = root.find("dimension");
  return node && node->kind == Kind::scalar && node->scalar == "3" ? 3 : 2;
}

void load_plugins(const YamlNode& root, const Scene& scene, PluginHost& host, Registry& registry) {
  if (const YamlNode* folders = root.find("plugin_folders");
      policy().restricted && !early_words(root, "plugin_folders").empty())
    throw Error(
        folders->where(),
        "plugin_folders: plugins are code, and --restricted loads none but those that are installed with "
        "Seam; take the key out");
  for (const std::string& folder : early_words(root, "plugin_folders"))
    host.add_folder(scene.path.parent_path() / folder);
  try {
    host.load(scene.plugins, registry);
  } catch (const PluginError& error) {
    const YamlNode* node = root.find("plugins");
    if (!node) throw;
    throw PluginError(node->where(), error.failures());
  }
}

/// A name that would forge lines of a log is no name of a scene.
void require_printable(const std::string& name) {
  if (on_one_line(name) == name) return;
  throw Error(
      fmt::format("error: the scene file '.. {}' has control characters in its name, or begins as a command "
                  "of continuous integration does; rename it, or write ./ before it",
                  on_one_line(name)));
}

/// Results of a stranger's scene stay below the current folder.
void check_output_folder(const Scene& scene, Diagnostics& diagnostics) {
  if (!policy().restricted || !scene.root.has("output")) return;
  const Parameters& output = scene.root.object("output");
  if (!output.has("folder")) return;
  const std::filesystem::path folder = output.text("folder");
  if (folder.is_relative() && std::ranges::find(folder, "..") == folder.end()) return;
  diagnostics.error(
      output.where("folder"),
      fmt::format("output.folder: found '{}', which --restricted does not allow; expected a relative path "
                  "without '..', or --folder on the command line",
                  folder.string()));
}

void warn_of_hidden_plugins(const YamlNode& root, const PluginHost& host, Diagnostics& diagnostics) {
  const YamlNode* node = root.find("plugins");
  for (const PluginHost::Found& plugin : host.loaded())
    for (const std::filesystem::path& hidden : plugin.hidden)
      diagnostics.warning(
          node ? node->where() : Location{},
          fmt::format("plugins: '{}' is taken from '{}'; '{}', of the same name, is not used; "
                      "remove one of them",
                      plugin.name, plugin.file.string(), hidden.string()));
}

}  // namespace

void apply_overrides(YamlNode& root, const Overrides& overrides) {
  for (const auto& [key, value] : overrides) apply(root, key, value);
}

Location Scene::where(const std::string& map, const std::string& name) const {
  for (const auto& [key, entry] : root.map(map))
    if (key == name) return entry.where();
  return {};
}

Scene parse_scene_text(const std::string& text, const std::filesystem::path& path, const Overrides& overrides,
                       PluginHost& host, Registry& registry) {
  static const Schema schema = scene_schema();
  Scene scene;
  scene.path = path;
  scene.text = text;
  scene.overrides = overrides;
  YamlNode root = parse_yaml(text, path.string());
  if (root.kind == Kind::null) {
    throw Error({path.string(), 0, 0}, "the scene is empty; `seam explain scene` lists what it needs");
  }
  if (root.kind != Kind::map) {
    throw Error(
        root.where(),
        fmt::format("found {}, expected the keys of a scene (title, dimension, meshes, ...)", root.found()));
  }
  apply_overrides(root, overrides);
  refuse_newer_format(root);
  scene.plugins = early_words(root, "plugins");
  load_plugins(root, scene, host, registry);

  Diagnostics diagnostics;
  warn_of_hidden_plugins(root, host, diagnostics);
  if (YamlNode* parameters = root.find("parameters"); parameters && parameters->kind == Kind::map) {
    scene.parameters = evaluate_parameters(*parameters, diagnostics);
    // What is wrong here is reported now; the validation of the block would say it again.
    if (diagnostics.has_errors()) parameters->keys.clear(), parameters->items.clear();
  }
  ValidationContext context{
      registry,
      diagnostics,
      early_dimension(root),
      scene.parameters,
      path.parent_path(),
      true,
      [&](const std::string& kind, const std::string& type) { return host.provider(kind, type); },
      {}};
  create_functions(root, schema, context);
  scene.root = validate(root, schema, context, "");
  scene.function_parts = std::move(context.function_parts);
  check_output_folder(scene, diagnostics);
  cross_check(scene, registry, host.loaded(), context.used_plugins, diagnostics);
  diagnostics.throw_if_errors();
  scene.warnings = diagnostics;
  return scene;
}

Scene load_scene(const std::filesystem::path& path, const Overrides& overrides, PluginHost& host,
                 Registry& registry) {
  const std::string name = path.string();
  require_printable(name);
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) throw Error({name, 0, 0}, "there is no such file");
  constexpr std::size_t read_at_most = (1 << 20) + 1;  // one byte more than parse_yaml accepts
  std::ifstream stream(path, std::ios::binary);
  std::string text(read_at_most, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad() || !stream.eof()) {
    if (stream.gcount() == 0) throw Error({name, 0, 0}, "the file cannot be read");
  }
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return parse_scene_text(text, path, overrides, host, registry);
}

}  // namespace seam
