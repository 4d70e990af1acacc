// SPDX-License-Identifier: BSD-3-Clause
#include "seam/scene/formula_rates.hpp"

#include <muParser.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace seam {
namespace {

using Arguments = std::span<const Jet>;
using Apply = Jet (*)(Arguments);

Jet flag(bool is_true) { return {is_true ? 1.0 : 0.0}; }
bool holds(const Jet& a) { return a != Jet{}; }

Jet exponential(const Jet& a) {
  const double e = std::exp(a.value);
  return Jet::chain(a, e, e, e);
}

Jet logarithm(const Jet& a, double of_base) {
  const double slope = 1 / (a.value * of_base);
  return Jet::chain(a, std::log(a.value) / of_base, slope, -slope / a.value);
}

Jet power(const Jet& a, const Jet& b) {
  if (b.rate == 0 && b.second_rate == 0) {
    const double n = b.value;
    return Jet::chain(a, std::pow(a.value, n), n == 0 ? 0 : n * std::pow(a.value, n - 1),
                      n == 0 || n == 1 ? 0 : n * (n - 1) * std::pow(a.value, n - 2));
  }
  Jet result = exponential(b * logarithm(a, 1));
  result.value = std::pow(a.value, b.value);
  return result;
}

/// d atan2(y, x) = (x dy - y dx) / (x^2 + y^2)
Jet arc_tangent(const Jet& y, const Jet& x) {
  const Jet dy{y.rate, y.second_rate}, dx{x.rate, x.second_rate};
  const Jet rate = (x * dy - y * dx) / (x * x + y * y);
  return {std::atan2(y.value, x.value), rate.value, rate.rate};
}

/// A function of one number whose slope at x is `slope`, and the slope's derivative `second`.
Jet of_one(const Jet& a, double (*function)(double), double slope, double second) {
  return Jet::chain(a, function(a.value), slope, second);
}

/// r^3 x
double cubed(double r, double x) { return r * r * r * x; }

/// Halves round up: what has come to one from below was rounded down just before.
Jet rounded(const Jet& a) {
  const Jet up = a + Jet{0.5};
  const double whole = std::floor(up.value);
  return {up < Jet{whole} ? whole - 1 : whole};
}

Jet sum(Arguments a) {
  Jet all;
  for (const Jet& one : a) all = all + one;
  return all;
}

const std::map<std::string, Apply>& functions() {
  static const std::map<std::string, Apply> all{
      {"sin",
       [](Arguments a) {
         const double s = std::sin(a[0].value);
         return Jet::chain(a[0], s, std::cos(a[0].value), -s);
       }},
      {"cos",
       [](Arguments a) {
         const double c = std::cos(a[0].value);
         return Jet::chain(a[0], c, -std::sin(a[0].value), -c);
       }},
      {"tan",
       [](Arguments a) {
         const double t = std::tan(a[0].value), slope = 1 + t * t;
         return Jet::chain(a[0], t, slope, 2 * t * slope);
       }},
      {"asin",
       [](Arguments a) {
         const double x = a[0].value, r = 1 / std::sqrt(1 - x * x);
         return of_one(a[0], std::asin, r, cubed(r, x));
       }},
      {"acos",
       [](Arguments a) {
         const double x = a[0].value, r = 1 / std::sqrt(1 - x * x);
         return of_one(a[0], std::acos, -r, -cubed(r, x));
       }},
      {"atan",
       [](Arguments a) {
         const double x = a[0].value, slope = 1 / (1 + x * x);
         return of_one(a[0], std::atan, slope, -2 * x * slope * slope);
       }},
      {"atan2", [](Arguments a) { return arc_tangent(a[0], a[1]); }},
      {"sinh",
       [](Arguments a) {
         const double s = std::sinh(a[0].value);
         return Jet::chain(a[0], s, std::cosh(a[0].value), s);
       }},
      {"cosh",
       [](Arguments a) {
         const double c = std::cosh(a[0].value);
         return Jet::chain(a[0], c, std::sinh(a[0].value), c);
       }},
      {"tanh",
       [](Arguments a) {
         const double t = std::tanh(a[0].value), slope = 1 - t * t;
         return Jet::chain(a[0], t, slope, -2 * t * slope);
       }},
      {"asinh",
       [](Arguments a) {
         const double x = a[0].value, r = 1 / std::sqrt(x * x + 1);
         return of_one(a[0], std::asinh, r, -cubed(r, x));
       }},
      {"acosh",
       [](Arguments a) {
         const double x = a[0].value, r = 1 / std::sqrt(x * x - 1);
         return of_one(a[0], std::acosh, r, -cubed(r, x));
       }},
      {"atanh",
       [](Arguments a) {
         const double x = a[0].value, slope = 1 / (1 - x * x);
         return of_one(a[0], std::atanh, slope, 2 * x * slope * slope);
       }},
      {"exp", [](Arguments a) { return exponential(a[0]); }},
      {"ln", [](Arguments a) { return logarithm(a[0], 1); }},
      {"log", [](Arguments a) { return logarithm(a[0], 1); }},
      {"log2", [](Arguments a) { return logarithm(a[0], std::log(2.0)); }},
      {"log10", [](Arguments a) { return logarithm(a[0], std::log(10.0)); }},
      {"sqrt",
       [](Arguments a) {
         const double r = std::sqrt(a[0].value);
         return Jet::chain(a[0], r, 0.5 / r, -0.25 / (r * a[0].value));
       }},
      {"abs", [](Arguments a) { return a[0] < Jet{} ? -a[0] : a[0]; }},
      {"sign", [](Arguments a) { return Jet{a[0] < Jet{}   ? -1.0
                                            : a[0] > Jet{} ? 1.0
                                                           : 0.0}; }},
      {"rint", [](Arguments a) { return rounded(a[0]); }},
      {"min",
       [](Arguments a) {
         Jet least = a[0];
         for (const Jet& one : a)
           if (one < least) least = one;
         return least;
       }},
      {"max",
       [](Arguments a) {
         Jet most = a[0];
         for (const Jet& one : a)
           if (one > most) most = one;
         return most;
       }},
      {"sum", sum},
      {"avg", [](Arguments a) { return sum(a) / Jet{static_cast<double>(a.size())}; }}};
  return all;
}

using Address = mu::erased_fun_type;

Address called_by(const mu::Parser& parser) {
  const mu::ParserByteCode& code = parser.GetByteCode();
  for (std::size_t k = 0; k < code.GetSize(); ++k)
    if (code.GetBase()[k].Cmd == mu::cmFUNC) return code.GetBase()[k].Fun.cb._pRawFun;
  return nullptr;
}

/// By the functions that muParser calls: which name they had is lost in what it compiles.
const std::map<Address, Apply>& functions_by_address() {
  static const std::map<Address, Apply> all = [] {
    std::map<Address, Apply> result;
    mu::Parser parser;
    double x = 0;
    parser.DefineVar("x", &x);
    const auto add = [&](const std::string& text, Apply apply) {
      parser.SetExpr(text);
      parser.Eval();
      result.emplace(called_by(parser), apply);
    };
    for (const auto& [name, apply] : functions())
      if (parser.GetFunDef().contains(name)) add(name + (name == "atan2" ? "(x, x)" : "(x)"), apply);
    add("-x", [](Arguments a) { return -a[0]; });
    return result;
  }();
  return all;
}

/// @return false for a code that takes no two numbers
bool apply_operator(mu::ECmdCode code, Jet& a, const Jet& b) {
  switch (code) {
    case mu::cmADD:
      a = a + b;
      return true;
    case mu::cmSUB:
      a = a - b;
      return true;
    case mu::cmMUL:
      a = a * b;
      return true;
    case mu::cmDIV:
      a = a / b;
      return true;
    case mu::cmPOW:
      a = power(a, b);
      return true;
    case mu::cmLT:
      a = flag(a < b);
      return true;
    case mu::cmGT:
      a = flag(a > b);
      return true;
    case mu::cmLE:
      a = flag(a <= b);
      return true;
    case mu::cmGE:
      a = flag(a >= b);
      return true;
    case mu::cmEQ:
      a = flag(a == b);
      return true;
    case mu::cmNEQ:
      a = flag(!(a == b));
      return true;
    case mu::cmLAND:
      a = flag(holds(a) && holds(b));
      return true;
    case mu::cmLOR:
      a = flag(holds(a) || holds(b));
      return true;
    default:
      return false;
  }
}

}  // namespace

std::optional<Jet> evaluate_jet(const mu::Parser& parser, const std::array<Jet, 4>& variables,
                                const double* first) {
  const mu::ParserByteCode& code = parser.GetByteCode();
  const auto variable = [&](const mu::SToken& token) { return variables.at(token.Val.ptr - first); };
  std::vector<Jet> stack;
  for (const mu::SToken* token = code.GetBase(); token->Cmd != mu::cmEND; ++token) {
    switch (token->Cmd) {
      case mu::cmVAR:
        stack.push_back(variable(*token));
        break;
      case mu::cmVAL:
        stack.push_back(Jet{token->Val.data2});
        break;
      case mu::cmVARPOW2:
      case mu::cmVARPOW3:
      case mu::cmVARPOW4:
        stack.push_back(power(variable(*token), Jet{2.0 + (token->Cmd - mu::cmVARPOW2)}));
        break;
      case mu::cmVARMUL:
        stack.push_back(variable(*token) * Jet{token->Val.data} + Jet{token->Val.data2});
        break;
      case mu::cmIF: {
        const bool first_branch = holds(stack.back());
        stack.pop_back();
        if (!first_branch) token += token->Oprt.offset;
        break;
      }
      case mu::cmELSE:
        token += token->Oprt.offset;
        break;
      case mu::cmENDIF:
        break;
      case mu::cmFUNC: {
        const auto known = functions_by_address().find(token->Fun.cb._pRawFun);
        if (known == functions_by_address().end()) return std::nullopt;
        const std::size_t count = std::abs(token->Fun.argc);
        const Jet result = known->second(Arguments(stack).last(count));
        stack.resize(stack.size() - count);
        stack.push_back(result);
        break;
      }
      default: {
        const Jet second = stack.back();
        stack.pop_back();
        if (stack.empty() || !apply_operator(token->Cmd, stack.back(), second)) return std::nullopt;
      }
    }
  }
  if (stack.empty()) return std::nullopt;
  return stack.back();
}

}  // namespace seam
