// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace seam {

class Parameters;
class Schema;

/// What a value in a scene is.
enum class ValueKind {
  boolean,
  integer,
  number,  ///< a constant; may be written as an expression of the scene's parameters
  text,
  choice,             ///< one of a fixed set of words
  vector,             ///< list of constants
  expression,         ///< scalar function of x, y, z, t
  vector_expression,  ///< list of such functions, null for "not given" (as for a free component)
  file,               ///< path, relative to the scene's folder
  reference,          ///< name of a mesh, field, interface, ... defined elsewhere in the scene
  names,              ///< one word or a list of words (names of boundaries, plugins, ...)
  object,             ///< keys of a sub-schema
  list,               ///< list of objects of a sub-schema
  map,                ///< free names, each with an object of a sub-schema
  typed,  ///< object whose key `type` selects a registered type of a kind; or just the type's name
  typed_list,
  typed_map,
};

/// One key of a Schema: name, kind, unit, default, range, one line of meaning.
struct Parameter {
  std::string name;
  ValueKind kind = ValueKind::text;
  std::string help;
  std::string unit_text;
  bool required = true;
  std::string default_text;  ///< as it would be written in YAML; "" when there is none
  /// The default where it depends on keys declared before this one; `default_text` then says how.
  std::function<std::string(const Parameters& before)> default_by;
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool minimum_excluded = false;
  bool maximum_excluded = false;
  bool infinite = false;  ///< number: `.inf` is a value
  std::vector<std::string> choices;
  /// reference, names: what is named ("mesh", "field", "interface", "boundary", "region"; see naming());
  /// typed: the registry's kind
  std::string target;
  std::vector<std::string> types;     ///< reference: types of the core that what is named may have; none: any
  int size = 0;                       ///< vector: number of entries, 0 for the scene's dimension, -1 for any
  std::shared_ptr<const Schema> sub;  ///< object, list, map
  bool bare_values = false;           ///< map: entries are written as the value of the sub-schema's only key

  /// Unit of the value, for documentation. "" for a pure number.
  Parameter& unit(const std::string& u) {
    unit_text = u;
    return *this;
  }
  /// Makes the key optional with this value (written as in YAML).
  Parameter& otherwise(const std::string& value) {
    required = false;
    default_text = value;
    return *this;
  }
  /// Makes the key optional with a value that depends on keys of the same object, declared before this one.
  /// @param rule how, for `seam explain`
  /// @param value as written in YAML; a key that has a mistake is missing in what it is given
  Parameter& otherwise(const std::string& rule, std::function<std::string(const Parameters& before)> value) {
    default_by = std::move(value);
    return otherwise(rule);
  }
  /// Makes the key optional without a value: ask Parameters::has.
  Parameter& optional() {
    required = false;
    return *this;
  }
  Parameter& at_least(double v) {
    minimum = v;
    minimum_excluded = false;
    return *this;
  }
  Parameter& at_most(double v) {
    maximum = v;
    maximum_excluded = false;
    return *this;
  }
  Parameter& above(double v) {
    minimum = v;
    minimum_excluded = true;
    return *this;
  }
  Parameter& below(double v) {
    maximum = v;
    maximum_excluded = true;
    return *this;
  }
  /// Accepts `.inf`, where that means something.
  Parameter& or_infinite() {
    infinite = true;
    return *this;
  }
  Parameter& entries(int n) {
    size = n;
    return *this;
  }
  /// What the words of a `reference` or of `names` stand for, so that they are checked: "mesh", "field" or
  /// "interface" of the scene; "boundary" or "region" of the mesh that the same object, or one around it,
  /// names by its key `mesh` or `field`; "boundary:KEY" takes the field that its key KEY names instead.
  Parameter& naming(const std::string& what) {
    target = what;
    return *this;
  }
  /// Of the core's types what is named has to have one of these. Types of plugins pass.
  Parameter& of_types(std::vector<std::string> names) {
    types = std::move(names);
    return *this;
  }
};

/// The keys a type accepts, declared once. Validation, `seam explain`, the JSON Schema and the reference
/// pages all come from here.
class Schema {
 public:
  explicit Schema(std::string summary = "");
  Schema(const Schema&);
  Schema(Schema&&) noexcept;
  Schema& operator=(const Schema&);
  Schema& operator=(Schema&&) noexcept;
  ~Schema();

  // The returned reference is valid until the next key is added.
  Parameter& boolean(const std::string& name, const std::string& help);
  Parameter& integer(const std::string& name, const std::string& help);
  Parameter& number(const std::string& name, const std::string& help);
  Parameter& text(const std::string& name, const std::string& help);
  Parameter& choice(const std::string& name, const std::string& help, std::vector<std::string> choices);
  Parameter& vector(const std::string& name, const std::string& help);
  Parameter& expression(const std::string& name, const std::string& help);
  Parameter& vector_expression(const std::string& name, const std::string& help);
  Parameter& file(const std::string& name, const std::string& help);
  Parameter& reference(const std::string& name, const std::string& help, const std::string& target);
  Parameter& names(const std::string& name, const std::string& help);
  Parameter& object(const std::string& name, const std::string& help, Schema sub);
  Parameter& list(const std::string& name, const std::string& help, Schema sub);
  Parameter& map(const std::string& name, const std::string& help, Schema sub);
  /// A map whose entries are written bare, `h: 1/16`: the value of the only key that `sub` declares.
  Parameter& value_map(const std::string& name, const std::string& help, Schema sub);
  Parameter& typed(const std::string& name, const std::string& help, const std::string& kind);
  Parameter& typed_list(const std::string& name, const std::string& help, const std::string& kind);
  Parameter& typed_map(const std::string& name, const std::string& help, const std::string& kind);

  [[nodiscard]] const std::string& summary() const { return summary_; }
  [[nodiscard]] const std::vector<Parameter>& parameters() const { return parameters_; }
  [[nodiscard]] const Parameter* find(const std::string& name) const;

 private:
  Parameter& add(const std::string& name, ValueKind kind, const std::string& help);
  std::string summary_;
  std::vector<Parameter> parameters_;
};

}  // namespace seam
