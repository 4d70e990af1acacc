// SPDX-License-Identifier: BSD-3-Clause
#include "condition.hpp"

#include <fmt/format.h>

#include <cctype>
#include <utility>

#include "seam/scene/expression.hpp"

namespace seam::cli {
namespace {

bool is_constant(const std::string& text) {
  try {
    evaluate_constant(text, {});
    return true;
  } catch (const Error&) {
    return false;
  }
}

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_in_name(char c) {
  return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.';
}

}  // namespace

Condition::Condition(const Vary& vary, std::string text, Location where)
    : text_(std::move(text)), where_(std::move(where)) {
  for (std::size_t k = 0; k < vary.keys.size(); ++k) {
    keys_[vary.keys[k].label] = keys_[vary.keys[k].path] = k;
    for (const std::string& value : vary.keys[k].values)
      if (!is_constant(value)) words_.emplace(value, words_.size());
  }
}

bool Condition::holds(const std::vector<std::string>& values,
                      const std::map<std::string, double>& parameters) const {
  try {
    return evaluate_constant(in_numbers(values), parameters) != 0;
  } catch (const Error& error) {
    throw Error(where_, fmt::format("'{}': {}", text_, error.what()));
  }
}

std::string Condition::in_numbers(const std::vector<std::string>& values) const {
  std::string result;
  for (std::size_t at = 0; at < text_.size();) {
    std::size_t end = at;
    while (end < text_.size() && is_in_name(text_[end])) ++end;
    if (end == at || !begins_name(text_[at])) {
      // A number, with what may stand behind its point, or a sign.
      end = std::max(end, at + 1);
      result += text_.substr(at, end - at);
    } else {
      const std::string name = text_.substr(at, end - at);
      if (const auto key = keys_.find(name); key != keys_.end())
        result += number_of(values[key->second]);
      else
        result += words_.contains(name) ? number_of(name) : name;
    }
    at = end;
  }
  return result;
}

std::string Condition::number_of(const std::string& value) const {
  // No value that is a number in a scene is as large as those that stand for words.
  constexpr double first_word = 1e200;
  const auto word = words_.find(value);
  return word == words_.end() ? "(" + value + ")" : fmt::format("{}", first_word * (word->second + 1));
}

}  // namespace seam::cli
