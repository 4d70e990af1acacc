// SPDX-License-Identifier: BSD-3-Clause
#include "seam/scene/validate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "seam/base/policy.hpp"

namespace seam {

namespace {

using Value = Parameters::Value;
using Kind = YamlNode::Kind;

std::string did_you_mean(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string guess = nearest_name(name, candidates);
  return guess.empty() ? "" : fmt::format(" Did you mean '{}'?", guess);
}

std::string listed(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

/// Letters, digits, '_' and '-', not starting with a digit: fit for file names and messages.
bool is_name(const std::string& s) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto other = [](char c) { return (c >= '0' && c <= '9') || c == '-'; };
  return !s.empty() && s.size() <= 64 && letter(s[0]) &&
         std::all_of(s.begin(), s.end(), [&](char c) { return letter(c) || other(c); });
}

/// "boundary[0].velocity" as `--set` takes it: "boundary.0.velocity".
std::string key_path(std::string path) {
  std::replace(path.begin(), path.end(), '[', '.');
  std::erase(path, ']');
  return path;
}

/// Validates the values of one scene. Functions that find an error report it and return nothing.
class Validator {
 public:
  explicit Validator(ValidationContext& context) : context_(context) {}

  Parameters object(const YamlNode& node, const Schema& schema, const std::string& path,
                    const std::string& type) {
    Parameters result;
    result.set_dimension(context_.dimension);
    result.set_where(node.where());
    result.set_type(type);
    if (node.kind != Kind::map && node.kind != Kind::null) {
      error(node, fmt::format("{}: found {}, expected an object", called(path), node.found()));
      return result;
    }
    check_keys(node, schema, path, type);
    for (const Parameter& parameter : schema.parameters()) set_parameter(result, node, parameter, path);
    return result;
  }

  std::optional<Parameters> typed(const YamlNode& node, const Parameter& p, const std::string& path) {
    const YamlNode* type = node.kind == Kind::map ? node.find("type") : &node;
    if (!type) {
      error(node, fmt::format("{} needs the key 'type': the name of {}. Known types: {}", path, p.target,
                              listed(context_.registry.names(p.target))));
      return {};
    }
    if (type->kind != Kind::scalar) {
      mismatch(*type, p, path);
      return {};
    }
    const Registry::Entry* entry = context_.registry.find(p.target, type->scalar);
    if (!entry) {
      unknown_type(*type, p, path);
      return {};
    }
    context_.used_plugins.insert(entry->plugin);
    if (node.kind == Kind::map) return object(node, entry->schema, path, entry->name);
    YamlNode empty;
    place_at(empty, node);
    return object(empty, entry->schema, path, entry->name);
  }

 private:
  void error(const YamlNode& node, const std::string& message) {
    context_.diagnostics.error(node.where(), message);
  }

  /// "found ..., expected ...", with the name of the key and its unit.
  void mismatch(const YamlNode& node, const Parameter& p, const std::string& path,
                const std::string& extra = "") {
    const std::string unit = p.unit_text.empty() ? "" : fmt::format(" [{}]", p.unit_text);
    error(node, fmt::format("{}: found {}, expected {}{}{}", path, node.found(),
                            describe(p, context_.dimension), unit, extra));
  }

  static std::string called(const std::string& path) { return path.empty() ? "the scene" : path; }
  static std::string join(const std::string& path, const std::string& key) {
    return path.empty() ? key : path + "." + key;
  }

  void check_keys(const YamlNode& node, const Schema& schema, const std::string& path,
                  const std::string& type) {
    std::vector<std::string> known;
    for (const Parameter& p : schema.parameters()) known.push_back(p.name);
    for (const YamlNode& key : node.keys) {
      if (schema.find(key.scalar) || (!type.empty() && key.scalar == "type")) continue;
      const std::string of = type.empty() ? called(path) : fmt::format("{} ({})", path, type);
      error(key, fmt::format("unknown key {} in {}.{} Known keys: {}", key.found(), of,
                             did_you_mean(key.scalar, known), listed(known)));
    }
  }

  void set_parameter(Parameters& result, const YamlNode& node, const Parameter& p, const std::string& path) {
    const YamlNode* given = node.find(p.name);
    // `key:` without a value is an optional key left open, as templates have it, but no required one.
    if (given && given->kind == Kind::null && !p.required) given = nullptr;
    if (given) {
      if (std::optional<Value> v = value(*given, p, join(path, p.name))) {
        v->where = given->where();
        result.set(p.name, std::move(*v));
      }
    } else if (p.required) {
      const std::string unit = p.unit_text.empty() ? "" : fmt::format(" [{}]", p.unit_text);
      error(node, fmt::format("{} needs the key '{}': {}{} ({})", called(path), p.name,
                              describe(p, context_.dimension), unit, p.help));
    } else if (!p.default_text.empty()) {
      YamlNode standard = parse_yaml(p.default_by ? p.default_by(result) : p.default_text, "default");
      place_at(standard, node);
      if (std::optional<Value> v = value(standard, p, join(path, p.name))) {
        v->where = node.where();
        v->given = false;
        result.set(p.name, std::move(*v));
      }
    }
  }

  /// Gives a default the place of the object it completes, so that messages lead somewhere.
  static void place_at(YamlNode& node, const YamlNode& place) {
    node.file = place.file;
    node.line = place.line;
    node.column = place.column;
    for (YamlNode& key : node.keys) place_at(key, place);
    for (YamlNode& item : node.items) place_at(item, place);
  }

  std::optional<Value> value(const YamlNode& node, const Parameter& p, const std::string& path) {
    switch (p.kind) {
      case ValueKind::boolean:
        return boolean(node, p, path);
      case ValueKind::integer:
        return integer(node, p, path);
      case ValueKind::number:
        return wrap(number(node, p, path));
      case ValueKind::text:
        return text(node, p, path);
      case ValueKind::choice:
        return choice(node, p, path);
      case ValueKind::vector:
        return vector(node, p, path);
      case ValueKind::expression:
        return wrap(expression(node, p, path));
      case ValueKind::vector_expression:
        return vector_expression(node, p, path);
      case ValueKind::file:
        return file(node, p, path);
      case ValueKind::reference:
        return reference(node, p, path);
      case ValueKind::names:
        return names(node, p, path);
      case ValueKind::object:
        return Value{std::vector<Parameters>{object(node, *p.sub, path, "")}, {}, {}};
      case ValueKind::list:
        return list(node, p, path);
      case ValueKind::map:
        return map(node, p, path);
      case ValueKind::typed:
        return wrap_object(typed(node, p, path));
      case ValueKind::typed_list:
        return list(node, p, path);
      case ValueKind::typed_map:
        return map(node, p, path);
    }
    return {};
  }

  template <class T>
  static std::optional<Value> wrap(std::optional<T> v) {
    if (!v) return {};
    return Value{std::move(*v), {}, {}};
  }
  static std::optional<Value> wrap_object(std::optional<Parameters> v) {
    if (!v) return {};
    return Value{std::vector<Parameters>{std::move(*v)}, {}, {}};
  }

  std::optional<Value> boolean(const YamlNode& node, const Parameter& p, const std::string& path) {
    if (node.kind == Kind::scalar && !node.quoted && (node.scalar == "true" || node.scalar == "false")) {
      return Value{node.scalar == "true", {}, {}};
    }
    mismatch(node, p, path);
    return {};
  }

  /// A constant, checked against the range.
  std::optional<double> number(const YamlNode& node, const Parameter& p, const std::string& path) {
    if (node.kind != Kind::scalar) {
      mismatch(node, p, path);
      return {};
    }
    if (p.infinite && node.scalar == ".inf") return std::numeric_limits<double>::infinity();
    try {
      const double v = evaluate_constant(node.scalar, context_.parameters);
      const bool low = p.minimum_excluded ? v <= p.minimum : v < p.minimum;
      const bool high = p.maximum_excluded ? v >= p.maximum : v > p.maximum;
      if (!low && !high) return v;
      const std::string unit = p.unit_text.empty() ? "" : " " + p.unit_text;
      error(node, fmt::format("{}: {} is out of range, expected {}{}", path, v, describe_range(p), unit));
    } catch (const Error& e) {
      error(node, fmt::format("{}: expected {}; {}", path, describe(p, context_.dimension), e.what()));
    }
    return {};
  }

  std::optional<Value> integer(const YamlNode& node, const Parameter& p, const std::string& path) {
    const std::optional<double> v = number(node, p, path);
    if (!v) return {};
    if (std::abs(*v) > static_cast<double>(largest_integer)) {
      error(node, fmt::format("{}: {} is out of range, expected a whole number of no more than {}", path,
                              node.found(), largest_integer));
      return {};
    }
    if (*v == std::floor(*v)) return Value{static_cast<long>(*v), {}, {}};
    mismatch(node, p, path);
    return {};
  }

  std::optional<Value> text(const YamlNode& node, const Parameter& p, const std::string& path) {
    if (node.kind == Kind::scalar) return Value{node.scalar, {}, {}};
    mismatch(node, p, path);
    return {};
  }

  std::optional<Value> choice(const YamlNode& node, const Parameter& p, const std::string& path) {
    const bool known = std::find(p.choices.begin(), p.choices.end(), node.scalar) != p.choices.end();
    if (node.kind == Kind::scalar && known) return Value{node.scalar, {}, {}};
    mismatch(node, p, path, "." + did_you_mean(node.scalar, p.choices));
    return {};
  }

  [[nodiscard]] bool right_size(const YamlNode& node, const Parameter& p) const {
    const std::size_t wanted = static_cast<std::size_t>(p.size > 0 ? p.size : context_.dimension);
    return node.kind == Kind::sequence && (p.size < 0 || node.items.size() == wanted);
  }

  std::optional<Value> vector(const YamlNode& node, const Parameter& p, const std::string& path) {
    if (!right_size(node, p)) {
      mismatch(node, p, path);
      return {};
    }
    Parameter entry = p;
    entry.kind = ValueKind::number;
    std::vector<double> values;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      if (const auto v = number(node.items[i], entry, fmt::format("{}[{}]", path, i))) values.push_back(*v);
    }
    if (values.size() != node.items.size()) return {};
    return Value{std::move(values), {}, {}};
  }

  std::optional<Expression> expression(const YamlNode& node, const Parameter& p, const std::string& path) {
    Parameter scalar = p;
    scalar.kind = ValueKind::expression;
    if (node.kind != Kind::scalar) {
      mismatch(node, scalar, path);
      return {};
    }
    if (const auto part = function_part(node, path)) {
      if (part->size() == 1) return part->front();
      if (!part->empty())
        error(node, fmt::format("{}: '{}' has {} components, expected one", path, node.scalar, part->size()));
      return {};
    }
    try {
      Expression result(node.scalar, context_.parameters);
      if (!result.is_constant()) return result;
      if (const auto v = number(node, scalar, path)) return Expression(*v);
    } catch (const Error& e) {
      error(node, fmt::format("{}: {}", path, e.what()));
    }
    return {};
  }

  /// The components of `function.part`; nothing when the text is something else, none after an error.
  std::optional<std::vector<Expression>> function_part(const YamlNode& node, const std::string& path) {
    const std::size_t dot = node.scalar.find('.');
    if (node.kind != Kind::scalar || dot == std::string::npos || !is_name(node.scalar.substr(0, dot)))
      return {};
    const std::string name = node.scalar.substr(0, dot), wanted = node.scalar.substr(dot + 1);
    const auto found = context_.functions.find(name);
    if (found == context_.functions.end()) {
      if (!is_name(wanted)) return {};  // a formula
      std::vector<std::string> known;
      for (const auto& entry : context_.functions) known.push_back(entry.first);
      error(node, fmt::format("{}: there is no function '{}' in `functions`.{} Known: {}", path, name,
                              did_you_mean(name, known), listed(known)));
      return std::vector<Expression>{};
    }
    if (!found->second) return std::vector<Expression>{};
    std::vector<std::string> known;
    for (const Function::Member& part : found->second->members()) {
      if (part.name == wanted) {
        context_.function_parts[key_path(path)] = node.scalar;
        return Expression::components(found->second, static_cast<int>(known.size()));
      }
      known.push_back(part.name);
    }
    error(node, fmt::format("{}: function '{}' has no part '{}'.{} It has: {}", path, name, wanted,
                            did_you_mean(wanted, known), listed(known)));
    return std::vector<Expression>{};
  }

  std::optional<Value> vector_expression(const YamlNode& node, const Parameter& p, const std::string& path) {
    if (auto part = function_part(node, path)) {
      const auto wanted = static_cast<std::size_t>(p.size > 0 ? p.size : context_.dimension);
      if (part->empty()) return {};
      if (p.size >= 0 && part->size() != wanted) {
        error(node, fmt::format("{}: '{}' has {} components, expected {}", path, node.scalar, part->size(),
                                wanted));
        return {};
      }
      std::vector<bool> given(part->size(), true);
      return Value{std::move(*part), std::move(given), {}};
    }
    if (!right_size(node, p)) {
      mismatch(node, p, path);
      return {};
    }
    std::vector<Expression> values;
    std::vector<bool> given;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      given.push_back(node.items[i].kind != Kind::null);
      if (!given.back()) {
        values.emplace_back();
      } else if (auto v = expression(node.items[i], p, fmt::format("{}[{}]", path, i))) {
        values.push_back(std::move(*v));
      }
    }
    if (values.size() != node.items.size()) return {};
    return Value{std::move(values), std::move(given), {}};
  }

  std::optional<Value> file(const YamlNode& node, const Parameter& p, const std::string& path) {
    if (node.kind != Kind::scalar || node.scalar.empty()) {
      mismatch(node, p, path);
      return {};
    }
    const std::filesystem::path full = context_.folder / node.scalar;
    std::error_code code;
    if (!is_below(full, context_.folder)) {
      const std::string message = fmt::format("{}: '{}' is a file outside the scene's folder", path,
                                              full.lexically_normal().string());
      if (policy().restricted) {
        error(node, message + ", which --restricted does not allow to be read; put it beside the scene");
        return {};
      }
      context_.diagnostics.warning(node.where(), message);
    }
    if (context_.files_must_exist && !std::filesystem::is_regular_file(full, code)) {
      error(node, fmt::format("{}: there is no file '{}'; it is looked for at '{}' (relative to the scene)",
                              path, node.scalar, full.lexically_normal().string()));
      return {};
    }
    if (const auto bytes = std::filesystem::file_size(full, code); !code)
      require_within(static_cast<double>(bytes), policy().limits.file_bytes, "file_bytes",
                     fmt::format("bytes in the file '{}'", node.scalar), node.where());
    return Value{full.lexically_normal().string(), {}, {}};
  }

  std::optional<Value> reference(const YamlNode& node, const Parameter& p, const std::string& path) {
    if (node.kind == Kind::scalar && !node.scalar.empty()) return Value{node.scalar, {}, {}};
    mismatch(node, p, path);
    return {};
  }

  std::optional<Value> names(const YamlNode& node, const Parameter& p, const std::string& path) {
    std::vector<std::string> result;
    if (node.kind == Kind::scalar) result.push_back(node.scalar);
    for (const YamlNode& item : node.items) {
      if (node.kind == Kind::sequence && item.kind == Kind::scalar) result.push_back(item.scalar);
    }
    const bool complete =
        node.kind == Kind::scalar || (node.kind == Kind::sequence && result.size() == node.items.size());
    if (!complete || std::find(result.begin(), result.end(), "") != result.end()) {
      mismatch(node, p, path);
      return {};
    }
    return Value{std::move(result), {}, {}};
  }

  void unknown_type(const YamlNode& type, const Parameter& p, const std::string& path) {
    const std::vector<std::string> known = context_.registry.names(p.target);
    const std::string plugin = context_.provider ? context_.provider(p.target, type.scalar) : "";
    const std::string hint =
        plugin.empty()
            ? did_you_mean(type.scalar, known)
            : fmt::format(" Plugin '{}' provides it but is not loaded: add it to `plugins`.", plugin);
    error(type, fmt::format("{}: unknown type {} of {}.{} Known types: {}", path, type.found(), p.target,
                            hint, listed(known)));
  }

  std::optional<Value> list(const YamlNode& node, const Parameter& p, const std::string& path) {
    if (node.kind != Kind::sequence) {
      mismatch(node, p, path);
      return {};
    }
    std::vector<Parameters> result;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const std::string entry = fmt::format("{}[{}]", path, i);
      if (p.kind == ValueKind::list) {
        result.push_back(object(node.items[i], *p.sub, entry, ""));
      } else if (auto v = typed(node.items[i], p, entry)) {
        result.push_back(std::move(*v));
      }
    }
    return Value{std::move(result), {}, {}};
  }

  std::optional<Value> map(const YamlNode& node, const Parameter& p, const std::string& path) {
    if (node.kind != Kind::map) {
      mismatch(node, p, path);
      return {};
    }
    Value::Map result;
    for (std::size_t i = 0; i < node.keys.size(); ++i) {
      const std::string& name = node.keys[i].scalar;
      if (!is_name(name)) {
        // Keys of bare values may be dotted: they name places in the scene.
        if (!p.bare_values || name.empty()) {
          error(node.keys[i],
                fmt::format("{}: {} cannot be a name; expected up to 64 letters, digits, '_' or '-', not "
                            "starting with a digit",
                            path, node.keys[i].found()));
          continue;
        }
      }
      if (std::optional<Parameters> entry = map_entry(node.items[i], p, join(path, name))) {
        result.emplace_back(name, std::move(*entry));
      }
    }
    return Value{std::move(result), {}, {}};
  }

  std::optional<Parameters> map_entry(const YamlNode& node, const Parameter& p, const std::string& path) {
    if (p.kind == ValueKind::typed_map) return typed(node, p, path);
    if (!p.bare_values) return object(node, *p.sub, path, "");
    Parameters result;
    result.set_dimension(context_.dimension);
    result.set_where(node.where());
    const Parameter& only = p.sub->parameters().front();
    std::optional<Value> v = value(node, only, path);
    if (!v) return {};
    v->where = node.where();
    result.set(only.name, std::move(*v));
    return result;
  }

  ValidationContext& context_;
};

}  // namespace

void create_functions(const YamlNode& node, const Schema& schema, ValidationContext& context) {
  const YamlNode* block = node.find("functions");
  if (!block || block->kind != Kind::map) return;
  const Parameter& parameter = *schema.find("functions");
  for (std::size_t i = 0; i < block->keys.size(); ++i) {
    const std::string& name = block->keys[i].scalar;
    std::shared_ptr<const Function>& function = context.functions[name];
    Diagnostics errors;
    ValidationContext apart{context.registry, errors, context.dimension, context.parameters,
                            context.folder,   true,   context.provider,  {}};
    const auto values = Validator(apart).typed(block->items[i], parameter, "functions." + name);
    if (!values || errors.has_errors()) continue;
    try {
      function = context.registry.create<Function>(parameter.target, *values);
    } catch (const Error& e) {
      context.diagnostics.error(values->where(), e.what());
    }
  }
}

Parameters validate(const YamlNode& node, const Schema& schema, ValidationContext& context,
                    const std::string& path) {
  return Validator(context).object(node, schema, path, "");
}

std::map<std::string, double> evaluate_parameters(const YamlNode& node, Diagnostics& diagnostics) {
  std::map<std::string, double> result;
  for (std::size_t i = 0; node.kind == Kind::map && i < node.keys.size(); ++i) {
    const std::string& name = node.keys[i].scalar;
    const Location where = node.keys[i].where();
    if (!is_name(name) || name.find('-') != std::string::npos) {
      diagnostics.error(where,
                        fmt::format("parameters: {} cannot be a name; expected letters, digits and '_', not "
                                    "starting with a digit",
                                    node.keys[i].found()));
    } else if (is_reserved_in_expressions(name)) {
      diagnostics.error(
          where,
          fmt::format("parameters: '{}' has a meaning of its own in expressions; choose another name", name));
    } else if (node.items[i].kind != Kind::scalar) {
      diagnostics.error(node.items[i].where(), fmt::format("parameters.{}: found {}, expected a number", name,
                                                           node.items[i].found()));
      result[name] = 1;  // so that those who use it are not in error, too
    } else {
      try {
        result[name] = evaluate_constant(node.items[i].scalar, result);
      } catch (const Error& e) {
        diagnostics.error(node.items[i].where(), fmt::format("parameters.{}: {}", name, e.what()));
        result[name] = 1;
      }
    }
  }
  return result;
}

}  // namespace seam
