// SPDX-License-Identifier: BSD-3-Clause
// The words in which messages, `seam explain` and the reference pages speak of a parameter.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "seam/scene/validate.hpp"

namespace seam {

namespace {

std::string count(const Parameter& parameter, int dimension) {
  if (parameter.size > 0) return fmt::format("{} ", parameter.size);
  if (parameter.size < 0) return "";
  return dimension > 0 ? fmt::format("{} ", dimension) : "dimension (2 or 3) ";
}

std::string article(const std::string& noun) {
  return (std::string("aeiou").find(noun.empty() ? ' ' : noun[0]) == std::string::npos ? "a " : "an ") + noun;
}

}  // namespace

std::string describe(const Parameter& p, int dimension) {
  const std::string noun = p.target.substr(0, p.target.find(':'));
  switch (p.kind) {
    case ValueKind::boolean:
      return "true or false";
    case ValueKind::integer:
      return "a whole number";
    case ValueKind::number:
      return "a number";
    case ValueKind::text:
      return "a text";
    case ValueKind::choice:
      return fmt::format("one of {}", fmt::join(p.choices, ", "));
    case ValueKind::vector:
      return fmt::format("a list of {}numbers", count(p, dimension));
    case ValueKind::expression:
      return "a number or an expression in x, y, z, t";
    case ValueKind::vector_expression:
      return fmt::format("a list of {}numbers or expressions in x, y, z, t", count(p, dimension));
    case ValueKind::file:
      return "the path of a file";
    case ValueKind::reference:
      return "the name of " + article(noun);
    case ValueKind::names:
      return noun.empty() ? "a name or a list of names"
                          : fmt::format("the name of {}, or a list of such names", article(noun));
    case ValueKind::object:
      return "an object";
    case ValueKind::list:
      return "a list of objects";
    case ValueKind::map:
      return p.bare_values ? "an object of free names with values" : "an object of free names";
    case ValueKind::typed:
      return fmt::format("{} (the type's name, or an object with 'type')", article(noun));
    case ValueKind::typed_list:
      return fmt::format("a list of {} objects, each with 'type'", noun);
    case ValueKind::typed_map:
      return fmt::format("free names, each with {} object with 'type'", article(noun));
  }
  return "";
}

std::string describe_range(const Parameter& p) {
  std::string result;
  if (std::isfinite(p.minimum))
    result = fmt::format("{} {}", p.minimum_excluded ? "above" : "at least", p.minimum);
  if (std::isfinite(p.maximum)) {
    result += fmt::format("{}{} {}", result.empty() ? "" : ", ", p.maximum_excluded ? "below" : "at most",
                          p.maximum);
  }
  return result;
}

}  // namespace seam
