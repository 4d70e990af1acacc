// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "seam/scene/scene.hpp"

namespace seam::cli {

/// What `vary` and `together` of a scene's blocks `study` and `matrix` say: keys, and the values of each.
struct Vary {
  struct Key {
    std::string path;                 ///< of the scene; or a word that the block itself understands
    std::string label;                ///< the same for readers: parameters by their names
    std::vector<std::string> values;  ///< as written
    Location where;
  };
  std::vector<Key> keys;
  std::vector<std::vector<std::size_t>> groups;  ///< of keys that change together
};

/// @param name of the block, for messages
/// @param is_own words in the place of a key path that the block itself understands
/// @throws Error with the place of a parameter that the scene does not have, of a key without values, of keys
/// that change together with different numbers of values
Vary read_vary(const Parameters& block, const std::string& name, const Scene& scene,
               const std::function<bool(const std::string&)>& is_own = {});

/// Position of the key that is called so, by label or path.
/// @throws Error at the place, beginning with `what`
std::size_t find_key(const Vary& vary, const std::string& name, const Location& where,
                     const std::string& what);

/// The values of all combinations, by key; the last group changes fastest.
/// @throws Error when there are more than ten thousand
std::vector<std::vector<std::string>> combinations(const Vary& vary, const Location& where);

}  // namespace seam::cli
