// SPDX-License-Identifier: BSD-3-Clause
#include "seam/scene/expression.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "seam/base/diagnostics.hpp"
#include "seam/base/rates.hpp"
#include "seam/scene/formula_rates.hpp"
#include "seam/scene/function.hpp"

namespace seam {

struct Expression::Compiled {
  virtual ~Compiled() = default;
  virtual double evaluate(const double* x, int dim, double t) = 0;
  virtual std::array<double, 2> rates(const double* x, int dim, double t) = 0;
};

struct Expression::Formula final : Expression::Compiled {
  mu::Parser parser;
  std::array<double, 4> variables{};  ///< x, y, z, t
  double evaluate(const double* x, int dim, double t) override {
    for (int i = 0; i < 3; ++i) variables[static_cast<std::size_t>(i)] = i < dim ? x[i] : 0.0;
    variables[3] = t;
    return parser.Eval();
  }
  std::array<double, 2> rates(const double* x, int dim, double t) override {
    std::array<Jet, 4> jets{};
    for (int i = 0; i < dim; ++i) jets[static_cast<std::size_t>(i)].value = x[i];
    jets[3] = {t, 1, 0};
    if (const std::optional<Jet> jet = evaluate_jet(parser, jets, variables.data()))
      return {jet->rate, jet->second_rate};
    return rates_of([&](double time) { return evaluate(x, dim, time); }, t);
  }
};

namespace {

/// Where something was evaluated last.
class LastPlace {
 public:
  /// Whether it is elsewhere now: from now on it is here.
  bool moves_to(const double* x, int dim, double t) {
    std::array<double, 4> here{0, 0, 0, t};
    std::copy_n(x, dim, here.begin());
    if (at_ == here) return false;
    at_ = here;
    return true;
  }

 private:
  std::optional<std::array<double, 4>> at_;
};

/// A part of a function with its values and rates where these were evaluated last.
struct LastValues {
  std::shared_ptr<const Function> function;
  int part;
  std::vector<double> value;
  std::vector<std::array<double, 2>> both_rates = std::vector<std::array<double, 2>>(value.size());
  LastPlace of_values{}, of_rates{};

  const std::vector<double>& evaluate(const double* x, int dim, double t) {
    if (of_values.moves_to(x, dim, t)) function->evaluate(part, x, t, value.data());
    return value;
  }
  const std::vector<std::array<double, 2>>& rates(const double* x, int dim, double t) {
    if (!of_rates.moves_to(x, dim, t)) return both_rates;
    std::vector<double> first(value.size()), second(value.size());
    function->rates(part, x, t, first.data(), second.data());
    for (std::size_t c = 0; c < value.size(); ++c) both_rates[c] = {first[c], second[c]};
    return both_rates;
  }
};

}  // namespace

struct Expression::Component final : Expression::Compiled {
  std::shared_ptr<LastValues> values;
  std::size_t component = 0;
  double evaluate(const double* x, int dim, double t) override {
    return values->evaluate(x, dim, t)[component];
  }
  std::array<double, 2> rates(const double* x, int dim, double t) override {
    return values->rates(x, dim, t)[component];
  }
};

namespace {

constexpr std::size_t longest_text = 4000;  // muParser gives up at 5000, with a message nobody understands
constexpr std::array<const char*, 4> variable_names{"x", "y", "z", "t"};

[[noreturn]] void fail(const std::string& text, const std::string& what) {
  const std::string shown = text.size() > 80 ? text.substr(0, 77) + "..." : text;
  throw Error(fmt::format("expression '{}': {}", shown, what));
}

/// Turns `${name}` into ` name ` of equal length, so that positions in messages stay true.
std::string without_braces(const std::string& text) {
  std::string result = text;
  for (std::size_t i = 0; (i = result.find("${", i)) != std::string::npos;) {
    const std::size_t end = result.find('}', i);
    if (end == std::string::npos) {
      fail(text, fmt::format("'${{' at character {} has no closing '}}'; write ${{name}}", i + 1));
    }
    result[i] = result[i + 1] = result[end] = ' ';
    i = end;
  }
  return result;
}

/// So many brackets nobody reads, and nobody but an attacker writes.
void check_nesting(const std::string& text, const std::string& plain) {
  constexpr int deepest = 200;
  int depth = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    depth += plain[i] == '(' ? 1 : plain[i] == ')' ? -1 : 0;
    if (depth > deepest)
      fail(text, fmt::format("more than {} brackets are open at character {}; name its parts in `parameters`",
                             deepest, i + 1));
  }
}

/// Makes known the constants that occur in a text: of thousands it uses a few.
void define_used(mu::Parser& parser, const std::string& plain,
                 const std::map<std::string, double>& constants) {
  const auto in_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  for (std::size_t i = 0; i < plain.size();) {
    std::size_t end = i;
    if (std::isdigit(static_cast<unsigned char>(plain[i])) == 0)
      while (end < plain.size() && in_name(plain[end])) ++end;
    if (const auto found = constants.find(plain.substr(i, end - i)); found != constants.end())
      parser.DefineConst(found->first, found->second);
    i = std::max(end, i + 1);
  }
}

/// Refuses what muParser would accept but nobody means in a scene: assignments, strings, other alphabets.
void check_characters(const std::string& text, const std::string& plain) {
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const char c = plain[i];
    const bool printable = (c >= 0x20 && c < 0x7f) || c == '\n' || c == '\t';
    if (!printable || std::string_view("\"';#$@\\`{}[]").find(c) != std::string_view::npos) {
      fail(text, fmt::format("character {} cannot be used here; expected numbers, names, operators and ( )",
                             i + 1));
    }
    if (c != '=') continue;
    const bool second = i > 0 && std::string_view("<>!=").find(plain[i - 1]) != std::string_view::npos;
    const bool first = i + 1 < plain.size() && plain[i + 1] == '=';
    if (!first && !second) fail(text, fmt::format("'=' at character {}; to compare, write '=='", i + 1));
  }
}

/// What muParser found wrong, in our words where its own do not help.
std::string explain(const mu::Parser::exception_type& e, const std::map<std::string, double>& parameters,
                    const mu::Parser& parser, bool with_variables) {
  const int position = std::max(0, static_cast<int>(e.GetPos())) + 1;
  if (e.GetCode() != mu::ecUNASSIGNABLE_TOKEN) {
    std::string reason = e.GetMsg();
    reason.erase(std::min(reason.size(), reason.find(" at position ")));
    while (!reason.empty() && (reason.back() == '.' || reason.back() == '\n')) reason.pop_back();
    return fmt::format("{} (at character {})", reason, position);
  }
  std::string token = e.GetToken();
  token.erase(token.find_last_not_of(" \t\n") + 1);
  if (token.find_first_of("0123456789.") == 0) {
    return fmt::format("'{}' at character {} is no number that a computer can hold", token, position);
  }
  std::vector<std::string> known{"pi"};
  if (with_variables) known.insert(known.end(), variable_names.begin(), variable_names.end());
  for (const auto& entry : parameters) known.push_back(entry.first);
  const std::string listed = fmt::format("{}", fmt::join(known, ", "));
  for (const auto& function : parser.GetFunDef()) known.push_back(function.first);
  const std::string guess = nearest_name(token, known);
  return fmt::format(
      "unknown name '{}' at character {}{}; known names: {} and functions such as sin, exp, min", token,
      position, guess.empty() ? "" : fmt::format(", did you mean '{}'?", guess), listed);
}

/// True and sets `value` when the text is a plain number, the common case.
bool plain_number(const std::string& text, double& value) {
  const char* first = text.data();
  const char* last = first + text.size();
  const auto [end, code] = std::from_chars(first, last, value);
  return code == std::errc{} && end == last && std::isfinite(value);
}

/// @param variables x, y, z, t, or null when the text must be a constant
void compile(mu::Parser& parser, const std::string& text, const std::map<std::string, double>& parameters,
             double* variables) {
  if (text.size() > longest_text) {
    fail(text, fmt::format("it has {} characters, at most {} are allowed", text.size(), longest_text));
  }
  const std::string plain = without_braces(text);
  check_characters(text, plain);
  check_nesting(text, plain);
  try {
    parser.DefineConst("pi", std::numbers::pi);
    define_used(parser, plain, parameters);
    for (std::size_t i = 0; variables && i < variable_names.size(); ++i) {
      parser.DefineVar(variable_names[i], variables + i);
    }
    parser.SetExpr(plain);
    parser.Eval();
    if (parser.GetNumResults() != 1) fail(text, "it has several results; expected one, without ','");
  } catch (const mu::Parser::exception_type& e) {
    const std::string& token = e.GetToken();
    const bool variable =
        std::find(variable_names.begin(), variable_names.end(), token) != variable_names.end();
    if (!variables && variable && e.GetCode() == mu::ecUNASSIGNABLE_TOKEN) {
      fail(text, fmt::format("it depends on '{}'; expected a constant, without position or time (x, y, z, t)",
                             token));
    }
    fail(text, explain(e, parameters, parser, variables != nullptr));
  }
}

double finite_value(const mu::Parser& parser, const std::string& text) {
  const double value = parser.Eval();
  if (!std::isfinite(value)) fail(text, fmt::format("its value is {}; expected a finite number", value));
  return value;
}

}  // namespace

Expression::Expression(const std::string& text, const std::map<std::string, double>& parameters)
    : text_(text) {
  if (plain_number(text, value_)) return;
  auto compiled = std::make_shared<Formula>();
  compile(compiled->parser, text, parameters, compiled->variables.data());
  if (!compiled->parser.GetUsedVar().empty()) {
    compiled_ = std::move(compiled);
    value_ = 0.0;
  } else {
    value_ = finite_value(compiled->parser, text);
  }
}

double Expression::operator()(const double* x, int dim, double t) const {
  return compiled_ ? compiled_->evaluate(x, dim, t) : value_;
}

std::array<double, 2> Expression::rates(const double* x, int dim, double t) const {
  return compiled_ ? compiled_->rates(x, dim, t) : std::array<double, 2>{};
}

std::vector<Expression> Expression::components(const std::shared_ptr<const Function>& function, int part) {
  const Function::Member& named = function->members().at(static_cast<std::size_t>(part));
  const auto count = static_cast<std::size_t>(named.components);
  auto values = std::make_shared<LastValues>(LastValues{function, part, std::vector<double>(count)});
  std::vector<Expression> result(count);
  for (std::size_t c = 0; c < count; ++c) {
    auto component = std::make_shared<Component>();
    component->values = values;
    component->component = c;
    result[c].compiled_ = std::move(component);
    result[c].text_ = fmt::format("{}[{}]", named.name, c);
  }
  return result;
}

double evaluate_constant(const std::string& text, const std::map<std::string, double>& parameters) {
  double value = 0.0;
  if (plain_number(text, value)) return value;
  mu::Parser parser;
  compile(parser, text, parameters, nullptr);
  return finite_value(parser, text);
}

double evaluate_formula(const std::string& text, const std::map<std::string, double>& values) {
  mu::Parser parser;
  compile(parser, text, values, nullptr);
  return parser.Eval();
}

bool is_reserved_in_expressions(const std::string& name) {
  static const mu::Parser plain;
  return name == "pi" ||
         std::find(variable_names.begin(), variable_names.end(), name) != variable_names.end() ||
         plain.GetFunDef().count(name) > 0 || plain.GetConst().count(name) > 0;
}

}  // namespace seam
