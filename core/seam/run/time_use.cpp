// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/time_use.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <set>
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
    if (key != "title" && key != "source" && key != "study" && key != "matrix" && key != "checks")
      visit_scalars(entry.second, path + key + ".", visit);
  }
}

/// The operand that begins at (step +1) or ends before (step -1) position `at`, up to what separates
/// operands outside of its own parentheses.
std::string operand(const std::string& text, std::size_t at, int step) {
  const std::string separators = step > 0 ? "?:,&|)<>=!" : "?:,&|(<>=!";
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

/// Whether t occurs as a name.
bool speaks_of_time(const std::string& text) {
  for (std::size_t at = text.find('t'); at != std::string::npos; at = text.find('t', at + 1))
    if ((at == 0 || !is_name(text[at - 1])) && (at + 1 == text.size() || !is_name(text[at + 1]))) return true;
  return false;
}

/// The arguments of a function whose parenthesis opens at position `at`.
std::vector<std::string> arguments(const std::string& text, std::size_t at) {
  std::vector<std::string> result;
  do {
    result.push_back(operand(text, at + 1, +1));
    at += 1 + result.back().size();
  } while (at < text.size() && text[at] == ',');
  return result;
}

/// Two numbers between which an expression changes its form when they become equal.
struct Condition {
  std::string left, right;
};

/// Those of an expression: what is compared, wherever it stands; the arguments of min and max; that of abs
/// and sign with 0.
std::vector<Condition> conditions(const std::string& text) {
  std::vector<Condition> result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool equal = at + 1 < text.size() && text[at + 1] == '=';
    const bool orders = text[at] == '<' || text[at] == '>';
    const bool equates = equal && (text[at] == '=' || text[at] == '!');
    if (orders || equates) result.push_back({operand(text, at, -1), operand(text, at + (equal ? 2 : 1), +1)});
    if (text[at] != '(') continue;
    std::size_t begin = at;
    while (begin > 0 && is_name(text[begin - 1])) --begin;
    const std::string name = text.substr(begin, at - begin);
    const bool is_extremum = name == "min" || name == "max";
    if (!is_extremum && name != "abs" && name != "sign") continue;
    const std::vector<std::string> given = arguments(text, at);
    if (!is_extremum) result.push_back({given.front(), "0"});
    for (std::size_t a = 0; is_extremum && a < given.size(); ++a)
      for (std::size_t b = a + 1; b < given.size(); ++b) result.push_back({given[a], given[b]});
  }
  return result;
}

bool is_t_alone(std::string text) {
  std::erase(text, ' ');
  return text == "t";
}

/// Appends the times within (from, to) at which a difference changes its sign, where it depends on the time
/// alone. What happens between two of `samples` times is not seen; what changes more often than `most` times
/// is for the steps to resolve.
void find_zeros(const Expression& difference, double from, double to, std::vector<double>& zeros) {
  constexpr int samples = 1000, compared = 7;
  constexpr std::size_t most = 50;
  constexpr std::array here{0.37, -0.21, 0.11}, there{-1.3, 2.7, 0.9};
  const auto value = [&](double t) { return difference(here.data(), 3, t); };
  for (int k = 0; k < compared; ++k) {
    const double time = from + (to - from) * (k + 0.5) / compared;
    const double elsewhere = difference(there.data(), 3, time);
    if (value(time) < elsewhere || value(time) > elsewhere) return;
  }
  std::vector<double> found;
  double before = from, value_before = value(from);
  for (int k = 1; k <= samples; ++k) {
    const double time = from + (to - from) * k / samples, now = value(time);
    double low = before, high = time;
    if (now == 0 && time < to) found.push_back(time);
    for (bool crosses = value_before * now < 0; crosses;) {
      const double middle = low + 0.5 * (high - low);
      if (middle <= low || middle >= high) {
        found.push_back(high);
        break;
      }
      const double at_middle = value(middle);
      (at_middle * value_before > 0 ? low : high) = middle;
    }
    if (found.size() > most) return;
    before = time;
    value_before = now;
  }
  zeros.insert(zeros.end(), found.begin(), found.end());
}

/// Looks at each condition of a scene once, within bounds: some scenes are long.
class Search {
 public:
  Search(const std::map<std::string, double>& parameters, double from, double to)
      : parameters_(parameters), from_(from), to_(to) {}

  void examine(const std::string& text, std::vector<double>& kinks) {
    if (!speaks_of_time(text) || !seen_.insert(text).second) return;
    for (const auto& [left, right] : conditions(text)) {
      if (!speaks_of_time(left) && !speaks_of_time(right)) continue;
      // What t itself is compared with is the time, to the bit.
      if (is_t_alone(left) && !speaks_of_time(right) && add_constant(right, kinks)) continue;
      if (is_t_alone(right) && !speaks_of_time(left) && add_constant(left, kinks)) continue;
      const std::string difference = "(" + left + ")-(" + right + ")";
      // Nested ones are about as long as what they stand in.
      if (!seen_.insert(difference).second || (left_ -= static_cast<long>(difference.size())) < 0) continue;
      try {
        find_zeros(Expression(difference, parameters_), from_, to_, kinks);
      } catch (const Error&) {
        // The text is no expression.
      }
    }
  }

 private:
  /// False where it depends on the position, or is no expression.
  bool add_constant(const std::string& text, std::vector<double>& kinks) const {
    try {
      kinks.push_back(evaluate_constant(text, parameters_));
      return true;
    } catch (const Error&) {
      return false;
    }
  }

  const std::map<std::string, double>& parameters_;
  double from_, to_;
  long left_ = 50000;  ///< characters of differences that may still be looked at: about half a second
  std::set<std::string> seen_;
};

}  // namespace

TimeUse find_time_use(const Scene& scene, double from, double to) {
  TimeUse use;
  Search search(scene.parameters, from, to);
  // What is recorded does not act.
  const auto look_at = [&](const std::string& path, const std::string& text) {
    use.any = use.any || speaks_of_time(text);
    if (!path.starts_with("output.")) search.examine(text, use.kinks);
  };
  const auto replaced = [&](const std::string& path) {
    return std::any_of(scene.overrides.begin(), scene.overrides.end(),
                       [&](const auto& entry) { return path.starts_with(entry.first + "."); });
  };
  visit_scalars(YAML::Load(scene.text), "", [&](const std::string& path, const std::string& text) {
    if (!replaced(path)) look_at(path, text);
  });
  for (const auto& entry : scene.overrides)
    visit_scalars(YAML::Load(entry.second), entry.first + ".", look_at);
  std::sort(use.kinks.begin(), use.kinks.end());
  use.kinks.erase(std::unique(use.kinks.begin(), use.kinks.end()), use.kinks.end());
  return use;
}

}  // namespace seam
