// SPDX-License-Identifier: BSD-3-Clause
#include "seam/scene/json_schema.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "seam/scene/validate.hpp"
#include "seam/scene/yaml_tree.hpp"

namespace seam {

namespace {

using json = nlohmann::ordered_json;

json reference_to(const std::string& definition) { return {{"$ref", "#/definitions/" + definition}}; }

/// A constant: a number in the range, or text that is evaluated (and checked) by Seam.
json number(const Parameter& p, const char* type) {
  json plain{{"type", type}};
  if (std::isfinite(p.minimum)) plain[p.minimum_excluded ? "exclusiveMinimum" : "minimum"] = p.minimum;
  if (std::isfinite(p.maximum)) plain[p.maximum_excluded ? "exclusiveMaximum" : "maximum"] = p.maximum;
  if (p.kind == ValueKind::integer && !std::isfinite(p.maximum)) plain["maximum"] = largest_integer;
  return {{"anyOf", {plain, {{"type", "string"}}}}};
}

json list_of(json items, const Parameter& p) {
  json result{{"type", "array"}, {"items", std::move(items)}};
  if (p.kind == ValueKind::list || p.kind == ValueKind::typed_list || p.size < 0) return result;
  result["minItems"] = p.size > 0 ? p.size : 2;
  result["maxItems"] = p.size > 0 ? p.size : 3;
  return result;
}

json map_of(json values) { return {{"type", "object"}, {"additionalProperties", std::move(values)}}; }

json object_schema(const Schema& schema);

json value_schema(const Parameter& p) {
  json word{{"type", "string"}, {"minLength", 1}};
  switch (p.kind) {
    case ValueKind::boolean:
      return {{"type", "boolean"}};
    case ValueKind::integer:
      return number(p, "integer");
    case ValueKind::number:
      return number(p, "number");
    case ValueKind::text:
      return {{"type", {"string", "number", "boolean"}}};
    case ValueKind::choice:
      return {{"enum", p.choices}};
    case ValueKind::vector:
      return list_of(number(p, "number"), p);
    case ValueKind::expression:
      return {{"type", {"number", "string"}}};
    case ValueKind::vector_expression:
      return {{"anyOf", {list_of({{"type", {"number", "string", "null"}}}, p), word}}};
    case ValueKind::file:
    case ValueKind::reference:
      return word;
    case ValueKind::names: {
      // Groups of a mesh may be called by their numbers; what stands for no name may be any value.
      json types = p.target.empty() ? json{"string", "number", "boolean"} : json{"string", "number"};
      const json one{{"type", std::move(types)}, {"minLength", 1}};
      return {{"anyOf", {one, {{"type", "array"}, {"items", one}}}}};
    }
    case ValueKind::object:
      return object_schema(*p.sub);
    case ValueKind::list:
      return list_of(object_schema(*p.sub), p);
    case ValueKind::map:
      return map_of(p.bare_values ? value_schema(p.sub->parameters().front()) : object_schema(*p.sub));
    case ValueKind::typed:
      return reference_to(p.target);
    case ValueKind::typed_list:
      return list_of(reference_to(p.target), p);
    case ValueKind::typed_map:
      return map_of(reference_to(p.target));
  }
  return json::object();
}

std::string description(const Parameter& p) {
  std::string result = p.help;
  if (!p.unit_text.empty()) result += " [" + p.unit_text + "]";
  if (!p.default_text.empty()) result += " (default: " + p.default_text + ")";
  return result;
}

json object_schema(const Schema& schema) {
  json result{{"type", "object"}, {"description", schema.summary()}, {"additionalProperties", false}};
  result["properties"] = json::object();
  json required = json::array();
  for (const Parameter& p : schema.parameters()) {
    json value = value_schema(p);
    // Draft 7 ignores what stands next to a $ref, so the description needs a level of its own.
    if (value.contains("$ref")) value = {{"allOf", json::array({value})}};
    value["description"] = description(p);
    result["properties"][p.name] = std::move(value);
    if (p.required) required.push_back(p.name);
  }
  if (!required.empty()) result["required"] = std::move(required);
  return result;
}

/// A typed value: the type's name, or an object whose other keys depend on `type`.
json kind_schema(const std::string& kind, const Registry& registry) {
  const std::vector<std::string> names = registry.names(kind);
  json by_type = json::array();
  for (const std::string& name : names) {
    by_type.push_back(
        {{"if", {{"properties", {{"type", {{"const", name}}}}}}}, {"then", reference_to(kind + "." + name)}});
  }
  json object{{"type", "object"}, {"required", {"type"}}, {"properties", {{"type", {{"enum", names}}}}}};
  if (!by_type.empty()) object["allOf"] = std::move(by_type);
  return {{"oneOf", json::array({json{{"enum", names}}, std::move(object)})}};
}

void collect_kinds(const Schema& schema, std::set<std::string>& kinds) {
  for (const Parameter& p : schema.parameters()) {
    const bool typed =
        p.kind == ValueKind::typed || p.kind == ValueKind::typed_list || p.kind == ValueKind::typed_map;
    if (typed) kinds.insert(p.target);
    if (p.sub) collect_kinds(*p.sub, kinds);
  }
}

}  // namespace

std::string json_schema(const Schema& scene, const Registry& registry) {
  json root{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Seam scene"}};
  root.update(object_schema(scene));
  std::set<std::string> kinds;
  collect_kinds(scene, kinds);
  json definitions = json::object();
  for (const Registry::Entry& entry : registry.entries()) {
    collect_kinds(entry.schema, kinds);
    kinds.insert(entry.kind);
    json type = object_schema(entry.schema);
    type["properties"]["type"] = {{"const", entry.name}, {"description", entry.schema.summary()}};
    definitions[entry.kind + "." + entry.name] = std::move(type);
  }
  for (const std::string& kind : kinds) definitions[kind] = kind_schema(kind, registry);
  root["definitions"] = std::move(definitions);
  return root.dump(2) + "\n";
}

}  // namespace seam
