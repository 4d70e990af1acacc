// SPDX-License-Identifier: BSD-3-Clause
#include "seam/scene/parameters.hpp"

#include <stdexcept>

namespace seam {

Parameters::Parameters() = default;
Parameters::Parameters(const Parameters&) = default;
Parameters::Parameters(Parameters&&) noexcept = default;
Parameters& Parameters::operator=(const Parameters&) = default;
Parameters& Parameters::operator=(Parameters&&) noexcept = default;
Parameters::~Parameters() = default;

template <class T>
const T& Parameters::get(const std::string& key) const {
  const auto it = values_.find(key);
  if (it == values_.end()) {
    throw std::logic_error("parameter '" + key + "' of " + (type_.empty() ? "an object" : "'" + type_ + "'") +
                           " has no value; ask has() first, or give it a default in the schema");
  }
  const T* value = std::get_if<T>(&it->second.data);
  if (!value) {
    throw std::logic_error("parameter '" + key + "' of " + (type_.empty() ? "an object" : "'" + type_ + "'") +
                           " was declared with another kind than it is asked for");
  }
  return *value;
}

bool Parameters::has(const std::string& key) const { return values_.count(key) > 0; }

bool Parameters::given(const std::string& key) const {
  const auto it = values_.find(key);
  return it != values_.end() && it->second.given;
}

bool Parameters::boolean(const std::string& key) const { return get<bool>(key); }
long Parameters::integer(const std::string& key) const { return get<long>(key); }
double Parameters::number(const std::string& key) const { return get<double>(key); }
const std::string& Parameters::text(const std::string& key) const { return get<std::string>(key); }
const std::vector<double>& Parameters::vector(const std::string& key) const {
  return get<std::vector<double>>(key);
}
const Expression& Parameters::expression(const std::string& key) const { return get<Expression>(key); }

const std::vector<Expression>& Parameters::vector_expression(const std::string& key) const {
  return get<std::vector<Expression>>(key);
}

bool Parameters::component_given(const std::string& key, int component) const {
  const auto count = static_cast<int>(get<std::vector<Expression>>(key).size());
  if (component < 0 || component >= count) {
    throw std::logic_error("component " + std::to_string(component) + " of '" + key + "' does not exist");
  }
  const std::vector<bool>& given = values_.at(key).component_given;
  return given.empty() || given[static_cast<std::size_t>(component)];
}

const std::vector<std::string>& Parameters::names(const std::string& key) const {
  return get<std::vector<std::string>>(key);
}

const Parameters& Parameters::object(const std::string& key) const {
  const auto& one = get<std::vector<Parameters>>(key);
  if (one.size() != 1) throw std::logic_error("parameter '" + key + "' is a list, not an object");
  return one.front();
}

const std::vector<Parameters>& Parameters::list(const std::string& key) const {
  return get<std::vector<Parameters>>(key);
}

const std::vector<std::pair<std::string, Parameters>>& Parameters::map(const std::string& key) const {
  return get<Value::Map>(key);
}

Location Parameters::where(const std::string& key) const {
  const auto it = values_.find(key);
  return it == values_.end() ? where_ : it->second.where;
}

void Parameters::set(const std::string& key, Value value) { values_[key] = std::move(value); }

}  // namespace seam
