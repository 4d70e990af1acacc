// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/time_use.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <string>

#include "seam/scene/expression.hpp"

namespace seam {
namespace {

bool is_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

using Visit = std::function<void(const std::string& path, const std::string& text)>;

/// Calls visit for every scalar of a document but those that are prose.
/// @param path of the node: keys and numbers with a dot behind each
void visit_scalars(const YAML::Node& node, const std::string& path, const Visit& visit) {
  if (node.IsScalar()) visit(path, node.Scalar());
  for (std::size_t k = 0; node.IsSequence() && k < node.size(); ++k)
    visit_scalars(node[k], path + std::to_string(k) + ".", visit);
  if (!node.IsMap()) return;
  for (const auto& entry : node) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    if (key != "title" && key != "source" && key != "study" && key != "checks")
      visit_scalars(entry.second, path + key + ".", visit);
  }
}

/// The operand that begins at (step +1) or ends before (step -1) position `at`, up to what separates
/// operands outside of its own parentheses.
std::string operand(const std::string& text, std::size_t at, int step) {
  const std::string separators = step > 0 ? "?:,&|)" : "?:,&|(<>=!";
  std::string result;
  int depth = 0;
  for (auto i = static_cast<std::ptrdiff_t>(at) - (step < 0 ? 1 : 0);
       i >= 0 && i < static_cast<std::ptrdiff_t>(text.size()); i += step) {
    const char c = text[i];
    const char opening = step > 0 ? '(' : ')', closing = step > 0 ? ')' : '(';
    if (depth == 0 && separators.find(c) != std::string::npos) break;
    if (c == opening) ++depth;
    if (c == closing) --depth;
    result += c;
  }
  if (step < 0) std::reverse(result.begin(), result.end());
  return result;
}

/// What t at position `at` is compared with, or its companion in min or max; "" for neither.
std::string companion(const std::string& text, std::size_t at) {
  std::size_t after = at + 1;
  while (after < text.size() && text[after] == ' ') ++after;
  if (after < text.size() && (text[after] == '<' || text[after] == '>')) {
    const bool equal = after + 1 < text.size() && text[after + 1] == '=';
    return operand(text, after + (equal ? 2 : 1), +1);
  }
  std::size_t before = at;
  while (before > 0 && text[before - 1] == ' ') --before;
  if (before > 0 && text[before - 1] == '=') --before;
  if (before > 0 && (text[before - 1] == '<' || text[before - 1] == '>'))
    return operand(text, before - 1, -1);
  const bool in_extremum =
      before >= 4 && text[before - 1] == '(' &&
      (text.compare(before - 4, 3, "min") == 0 || text.compare(before - 4, 3, "max") == 0);
  if (in_extremum && after < text.size() && text[after] == ',') return operand(text, after + 1, +1);
  return "";
}

void examine(const std::string& text, const std::map<std::string, double>& parameters, TimeUse& use) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool alone = text[at] == 't' && (at == 0 || !is_name(text[at - 1])) &&
                       (at + 1 == text.size() || !is_name(text[at + 1]));
    if (!alone) continue;
    use.any = true;
    const std::string other = companion(text, at);
    if (other.empty()) continue;
    try {
      use.kinks.push_back(evaluate_constant(other, parameters));
    } catch (const Error&) {
      // It depends on the position, or the text is no expression: then there is no single time.
    }
  }
}

}  // namespace

TimeUse find_time_use(const Scene& scene) {
  TimeUse use;
  const auto replaced = [&](const std::string& path) {
    return std::any_of(scene.overrides.begin(), scene.overrides.end(),
                       [&](const auto& entry) { return path.starts_with(entry.first + "."); });
  };
  visit_scalars(YAML::Load(scene.text), "", [&](const std::string& path, const std::string& text) {
    if (!replaced(path)) examine(text, scene.parameters, use);
  });
  for (const auto& entry : scene.overrides)
    visit_scalars(YAML::Load(entry.second), "",
                  [&](const std::string&, const std::string& text) { examine(text, scene.parameters, use); });
  std::sort(use.kinks.begin(), use.kinks.end());
  use.kinks.erase(std::unique(use.kinks.begin(), use.kinks.end()), use.kinks.end());
  return use;
}

}  // namespace seam
