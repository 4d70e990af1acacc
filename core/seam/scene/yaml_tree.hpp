// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "seam/base/diagnostics.hpp"

namespace seam {

/// A YAML document as plain data. Unlike yaml-cpp's own nodes it keeps the order of keys, whether a word was
/// quoted, and the place of every value; and it cannot hold what makes YAML dangerous to walk: cycles,
/// aliases, tags, duplicate keys, great depth.
struct YamlNode {
  enum class Kind { null, scalar, sequence, map };
  Kind kind = Kind::null;
  std::string scalar;
  bool quoted = false;
  std::vector<YamlNode> keys;   ///< of a map: scalars, in the order of the file
  std::vector<YamlNode> items;  ///< of a sequence, or the values of a map (as many as keys)
  int line = 0;
  int column = 0;
  std::shared_ptr<const std::string> file;

  [[nodiscard]] Location where() const { return {file ? *file : "", line, column}; }
  /// The value of a key of a map; null when there is none (or this is no map).
  [[nodiscard]] const YamlNode* find(const std::string& key) const;
  [[nodiscard]] YamlNode* find(const std::string& key);
  /// What stands here, for messages: "'text'", "a list of 3 entries", "nothing".
  [[nodiscard]] std::string found() const;
};

struct YamlLimits {
  std::size_t bytes = 1 << 20;
  std::size_t nodes = 100000;
  int depth = 24;
};

/// Parses one YAML document.
/// @param name of the file, for messages
/// @throws Error with all duplicate keys and, for anything else (syntax, text that is not UTF-8, anchors,
/// tags,
///         several documents, more than the limits), the first place.
YamlNode parse_yaml(const std::string& text, const std::string& name, const YamlLimits& limits = {});

}  // namespace seam
