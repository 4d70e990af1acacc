// SPDX-License-Identifier: BSD-3-Clause
#include "seam/scene/schema.hpp"

#include <algorithm>
#include <stdexcept>

namespace seam {

Schema::Schema(std::string summary) : summary_(std::move(summary)) {}
Schema::Schema(const Schema&) = default;
Schema::Schema(Schema&&) noexcept = default;
Schema& Schema::operator=(const Schema&) = default;
Schema& Schema::operator=(Schema&&) noexcept = default;
Schema::~Schema() = default;

Parameter& Schema::add(const std::string& name, ValueKind kind, const std::string& help) {
  if (find(name)) throw std::logic_error("schema declares the key '" + name + "' twice");
  Parameter& parameter = parameters_.emplace_back();
  parameter.name = name;
  parameter.kind = kind;
  parameter.help = help;
  return parameter;
}

const Parameter* Schema::find(const std::string& name) const {
  const auto it = std::find_if(parameters_.begin(), parameters_.end(),
                               [&](const Parameter& p) { return p.name == name; });
  return it == parameters_.end() ? nullptr : &*it;
}

Parameter& Schema::boolean(const std::string& name, const std::string& help) {
  return add(name, ValueKind::boolean, help);
}
Parameter& Schema::integer(const std::string& name, const std::string& help) {
  return add(name, ValueKind::integer, help);
}
Parameter& Schema::number(const std::string& name, const std::string& help) {
  return add(name, ValueKind::number, help);
}
Parameter& Schema::text(const std::string& name, const std::string& help) {
  return add(name, ValueKind::text, help);
}
Parameter& Schema::choice(const std::string& name, const std::string& help,
                          std::vector<std::string> choices) {
  Parameter& parameter = add(name, ValueKind::choice, help);
  parameter.choices = std::move(choices);
  return parameter;
}
Parameter& Schema::vector(const std::string& name, const std::string& help) {
  return add(name, ValueKind::vector, help);
}
Parameter& Schema::expression(const std::string& name, const std::string& help) {
  return add(name, ValueKind::expression, help);
}
Parameter& Schema::vector_expression(const std::string& name, const std::string& help) {
  return add(name, ValueKind::vector_expression, help);
}
Parameter& Schema::file(const std::string& name, const std::string& help) {
  return add(name, ValueKind::file, help);
}
Parameter& Schema::reference(const std::string& name, const std::string& help, const std::string& target) {
  return add(name, ValueKind::reference, help).naming(target);
}
Parameter& Schema::names(const std::string& name, const std::string& help) {
  return add(name, ValueKind::names, help);
}

namespace {
Parameter& with_sub_schema(Parameter& parameter, Schema sub) {
  parameter.sub = std::make_shared<const Schema>(std::move(sub));
  return parameter;
}
}  // namespace

Parameter& Schema::object(const std::string& name, const std::string& help, Schema sub) {
  return with_sub_schema(add(name, ValueKind::object, help), std::move(sub));
}
Parameter& Schema::list(const std::string& name, const std::string& help, Schema sub) {
  return with_sub_schema(add(name, ValueKind::list, help), std::move(sub));
}
Parameter& Schema::map(const std::string& name, const std::string& help, Schema sub) {
  return with_sub_schema(add(name, ValueKind::map, help), std::move(sub));
}
Parameter& Schema::value_map(const std::string& name, const std::string& help, Schema sub) {
  if (sub.parameters().size() != 1)
    throw std::logic_error("value_map '" + name + "' needs a sub-schema of one key");
  Parameter& parameter = with_sub_schema(add(name, ValueKind::map, help), std::move(sub));
  parameter.bare_values = true;
  return parameter;
}
Parameter& Schema::typed(const std::string& name, const std::string& help, const std::string& kind) {
  return add(name, ValueKind::typed, help).naming(kind);
}
Parameter& Schema::typed_list(const std::string& name, const std::string& help, const std::string& kind) {
  return add(name, ValueKind::typed_list, help).naming(kind);
}
Parameter& Schema::typed_map(const std::string& name, const std::string& help, const std::string& kind) {
  return add(name, ValueKind::typed_map, help).naming(kind);
}

}  // namespace seam
