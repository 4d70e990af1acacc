// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "seam/base/diagnostics.hpp"
#include "seam/scene/expression.hpp"

namespace seam {

/// The validated values of one object of a scene. Every accessor assumes the key was declared in the schema
/// with that kind: asking for another is a programming error (std::logic_error), never a user's.
class Parameters {
 public:
  Parameters();
  Parameters(const Parameters&);
  Parameters(Parameters&&) noexcept;
  Parameters& operator=(const Parameters&);
  Parameters& operator=(Parameters&&) noexcept;
  ~Parameters();
  /// True when the key was given or has a default.
  [[nodiscard]] bool has(const std::string& key) const;
  /// True when the scene itself gives the key (a default does not count).
  [[nodiscard]] bool given(const std::string& key) const;

  [[nodiscard]] bool boolean(const std::string& key) const;
  [[nodiscard]] long integer(const std::string& key) const;
  [[nodiscard]] double number(const std::string& key) const;
  [[nodiscard]] const std::string& text(
      const std::string& key) const;  ///< text, choice, file (resolved), reference
  [[nodiscard]] const std::vector<double>& vector(const std::string& key) const;
  [[nodiscard]] const Expression& expression(const std::string& key) const;
  /// One entry per component; use `component_given` where null marks a free component.
  [[nodiscard]] const std::vector<Expression>& vector_expression(const std::string& key) const;
  [[nodiscard]] bool component_given(const std::string& key, int component) const;
  [[nodiscard]] const std::vector<std::string>& names(const std::string& key) const;
  [[nodiscard]] const Parameters& object(const std::string& key) const;             ///< object, typed
  [[nodiscard]] const std::vector<Parameters>& list(const std::string& key) const;  ///< list, typed_list
  /// In the order of the scene.
  [[nodiscard]] const std::vector<std::pair<std::string, Parameters>>& map(const std::string& key) const;

  /// The registered type's name, for a typed object.
  [[nodiscard]] const std::string& type() const { return type_; }
  /// Space dimension of the scene, 2 or 3.
  [[nodiscard]] int dimension() const { return dimension_; }
  /// Where the key (or, without one, the object) stands.
  [[nodiscard]] Location where(const std::string& key = "") const;

  /// Values as a validated scene (or a test) stores them.
  struct Value {
    using Map = std::vector<std::pair<std::string, Parameters>>;
    std::variant<bool, long, double, std::string, std::vector<double>, Expression, std::vector<Expression>,
                 std::vector<std::string>, std::vector<Parameters>, Map>
        data;
    std::vector<bool> component_given;  ///< vector_expression only
    Location where;
    bool given = true;
  };
  void set(const std::string& key, Value value);
  void set_type(std::string type) { type_ = std::move(type); }
  void set_dimension(int dimension) { dimension_ = dimension; }
  void set_where(Location where) { where_ = std::move(where); }

 private:
  template <class T>
  const T& get(const std::string& key) const;
  std::map<std::string, Value> values_;
  std::string type_;
  int dimension_ = 2;
  Location where_;
};

}  // namespace seam
