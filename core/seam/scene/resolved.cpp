// SPDX-License-Identifier: BSD-3-Clause
#include "seam/scene/resolved.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <set>
#include <vector>

#include "seam/base/checksum.hpp"
#include "seam/scene/scene_values.hpp"
#include "seam/scene/validate.hpp"

namespace seam {
namespace {

/// As short as it can be with the same bits; one zero.
std::string number(double value) { return fmt::format("{}", value + 0.0); }

bool in_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// A formula in one spelling: no blanks, numbers as short as they can be, parameters by their values.
std::string formula(const std::string& text, const std::map<std::string, double>& parameters) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const char* const start = text.data() + i;
    const bool point = text[i] == '.' && i + 1 < text.size() && is_digit(text[i + 1]);
    double value = 0;
    if (is_digit(text[i]) || point) {
      const auto [end, code] = std::from_chars(start, text.data() + text.size(), value);
      // What no double can hold has been refused.
      result += code == std::errc{} ? number(value) : std::string(start, end);
      i += static_cast<std::size_t>(end - start);
    } else if (in_name(text[i])) {
      std::size_t end = i;
      while (end < text.size() && in_name(text[end])) ++end;
      const std::string name = text.substr(i, end - i);
      const auto found = parameters.find(name);
      if (found == parameters.end())
        result += name;
      else
        result += found->second < 0 ? "(" + number(found->second) + ")" : number(found->second);
      i = end;
    } else {
      // `${name}` is `name`.
      if (std::string_view(" \t\n\r${}").find(text[i]) == std::string_view::npos) result += text[i];
      ++i;
    }
  }
  return result;
}

/// The format of a mesh is told by the end of its name; else the name does not matter.
std::string content(const std::string& file, const Location& where) {
  const std::string sum = content_checksum(file);
  if (sum.empty())
    throw Error(where, fmt::format("the file '{}' cannot be read; it was there when the scene was", file));
  return fmt::format("checksum {}, {}", sum, std::filesystem::path(file).extension().string());
}

class Resolver {
 public:
  Resolver(const Scene& scene, const Registry& registry) : scene_(scene), registry_(registry) {}

  void object(const Parameters& values, const Schema& schema, const std::string& path) {
    const std::size_t before = result_.size();
    if (!values.type().empty()) result_[path + ".type"] = values.type();
    for (const Parameter& p : schema.parameters())
      if (values.has(p.name)) value(values, p, path.empty() ? p.name : path + "." + p.name);
    if (result_.size() == before) result_[path] = "{}";  // that it is there may mean something
  }

  ResolvedScene take() { return std::move(result_); }

 private:
  void typed(const Parameters& values, const std::string& kind, const std::string& path) {
    object(values, registry_.find(kind, values.type())->schema, path);
  }

  void value(const Parameters& of, const Parameter& p, const std::string& path) {
    switch (p.kind) {
      case ValueKind::boolean:
        result_[path] = of.boolean(p.name) ? "true" : "false";
        return;
      case ValueKind::integer:
        result_[path] = fmt::format("{}", of.integer(p.name));
        return;
      case ValueKind::number:
        result_[path] = number(of.number(p.name));
        return;
      case ValueKind::text:
      case ValueKind::choice:
      case ValueKind::reference:
        result_[path] = of.text(p.name);
        return;
      case ValueKind::vector: {
        std::vector<std::string> entries;
        for (const double v : of.vector(p.name)) entries.push_back(number(v));
        result_[path] = fmt::format("[{}]", fmt::join(entries, ", "));
        return;
      }
      case ValueKind::expression:
        result_[path] = expression(of.expression(p.name), path);
        return;
      case ValueKind::vector_expression:
        components(of, p, path);
        return;
      case ValueKind::file:
        result_[path] = content(of.text(p.name), of.where(p.name));
        return;
      case ValueKind::names:
        result_[path] = fmt::format("[{}]", fmt::join(of.names(p.name), ", "));
        return;
      case ValueKind::object:
        object(of.object(p.name), *p.sub, path);
        return;
      case ValueKind::typed:
        typed(of.object(p.name), p.target, path);
        return;
      case ValueKind::list:
      case ValueKind::typed_list:
        list(of.list(p.name), p, path);
        return;
      case ValueKind::map:
      case ValueKind::typed_map:
        map(of.map(p.name), p, path);
        return;
    }
  }

  [[nodiscard]] std::string expression(const Expression& e, const std::string& path) const {
    const auto part = scene_.function_parts.find(path);
    if (part != scene_.function_parts.end()) return part->second;
    constexpr std::array<double, 3> anywhere{};
    return e.is_constant() ? number(e(anywhere.data(), 3, 0)) : formula(e.text(), scene_.parameters);
  }

  void components(const Parameters& of, const Parameter& p, const std::string& path) {
    if (const auto part = scene_.function_parts.find(path); part != scene_.function_parts.end()) {
      result_[path] = part->second;
      return;
    }
    const std::vector<Expression>& all = of.vector_expression(p.name);
    std::vector<std::string> entries;
    for (std::size_t i = 0; i < all.size(); ++i)
      entries.push_back(of.component_given(p.name, static_cast<int>(i))
                            ? expression(all[i], fmt::format("{}.{}", path, i))
                            : "null");
    result_[path] = fmt::format("[{}]", fmt::join(entries, ", "));
  }

  void list(const std::vector<Parameters>& entries, const Parameter& p, const std::string& path) {
    if (entries.empty()) result_[path] = "[]";
    for (std::size_t i = 0; i < entries.size(); ++i)
      entry(entries[i], p, fmt::format("{}.{}", path, i), p.kind == ValueKind::typed_list);
  }

  void map(const Parameters::Value::Map& entries, const Parameter& p, const std::string& path) {
    if (entries.empty()) result_[path] = "{}";
    for (const auto& [name, values] : entries) {
      const std::string at = path + "." + name;
      if (p.bare_values)
        value(values, p.sub->parameters().front(), at);
      else
        entry(values, p, at, p.kind == ValueKind::typed_map);
    }
  }

  void entry(const Parameters& values, const Parameter& p, const std::string& path, bool is_typed) {
    if (is_typed)
      typed(values, p.target, path);
    else
      object(values, *p.sub, path);
  }

  const Scene& scene_;
  const Registry& registry_;
  ResolvedScene result_;
};

/// What a scene without the block `time` does, as it would be written.
constexpr const char* standard_time = "{static: true, end: 1}";

void fill_in_time(const Schema& schema, const Registry& registry, Resolver& resolver) {
  Diagnostics none;
  ValidationContext context{registry, none, 2, {}, {}, false, {}, {}};
  const YamlNode standard = parse_yaml(standard_time, "default");
  const Schema& keys = *schema.find("time")->sub;
  resolver.object(validate(standard, keys, context, "time"), keys, "time");
}

}  // namespace

ResolvedScene resolve(const Scene& scene, const Registry& registry) {
  const Schema schema = scene_schema();
  Resolver resolver(scene, registry);
  resolver.object(scene.root, schema, "");
  if (!scene.root.has("time")) fill_in_time(schema, registry, resolver);
  return resolver.take();
}

bool determines_numbers(std::string_view path) {
  // Parameters are in the values that use them; what plugins provide is in the types that the scene uses.
  constexpr std::array<std::string_view, 11> other{"format", "title",      "source",  "tier",
                                                   "output", "parameters", "plugins", "plugin_folders",
                                                   "study",  "matrix",     "checks"};
  return std::ranges::none_of(other, [&](std::string_view block) { return is_or_is_within(path, block); });
}

bool says_what_is_measured(std::string_view path) {
  return is_or_is_within(path, "output.probes") || is_or_is_within(path, "output.errors");
}

std::string resolved_checksum(const ResolvedScene& values) {
  std::string all;
  for (const auto& [path, value] : values)
    if (determines_numbers(path)) all += fmt::format("{}: {}\n", path, value);
  return fmt::format("{:016x}", checksum(all));
}

std::vector<std::string> resolved_differences(const ResolvedScene& before, const ResolvedScene& now) {
  std::set<std::string> paths;
  for (const auto* values : {&before, &now})
    for (const auto& [path, value] : *values)
      if (determines_numbers(path) || says_what_is_measured(path)) paths.insert(path);
  const auto text = [](const ResolvedScene& values, const std::string& path) {
    const auto found = values.find(path);
    return found == values.end() ? "not there" : found->second;
  };
  std::vector<std::string> result;
  for (const std::string& path : paths)
    if (text(before, path) != text(now, path))
      result.push_back(fmt::format("{}: {}, now {}", path, text(before, path), text(now, path)));
  return result;
}

}  // namespace seam
