// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "seam/plugin/registry.hpp"
#include "seam/scene/scene.hpp"

namespace seam::cli {

/// What scenes use of all that scenes may name: registered types, values of keys that have a choice, and
/// which fields a coupling meets.
class Coverage {
 public:
  /// @param registry the scene's, with the types of its plugins
  void add(const Scene& scene, const Registry& registry);

  /// "coupling:spring" of each type that no scene uses, of one of these plugins ("core" for what is built
  /// in).
  [[nodiscard]] std::vector<std::string> unused_types(const std::set<std::string>& plugins) const;
  /// Names of all plugins whose types are known, "core" among them.
  [[nodiscard]] std::set<std::string> plugins() const;

  /// A page that lists what is not used.
  [[nodiscard]] std::string as_markdown() const;

 private:
  struct Type {
    std::string plugin;
    int scenes = 0;  ///< that use it
  };
  void enumerate(const Schema& schema, const std::string& label);
  void walk(const Parameters& values, const Schema& schema, const std::string& label,
            const Registry& registry);
  void walk_typed(const Parameters& values, const std::string& kind, const Registry& registry);
  void meet_fields(const Scene& scene, const Registry& registry);

  std::map<std::string, Type> types_;                                 ///< by "kind:name"
  std::map<std::string, std::map<std::string, int>> choices_;         ///< by key and value: scenes
  std::map<std::string, std::set<std::string>> fields_of_couplings_;  ///< types
  std::set<std::string> used_;  ///< types and choices of the scene that is added
};

}  // namespace seam::cli
