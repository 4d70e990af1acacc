// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace seam {

/// Text as the value of an XML attribute.
inline std::string xml_escape(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

/// The inverse of xml_escape; other entities stay as they are.
inline std::string xml_unescape(const std::string& text) {
  static const std::string entities[][2] = {{"&amp;", "&"}, {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}};
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const auto* found = std::begin(entities);
    while (found != std::end(entities) && text.compare(at, (*found)[0].size(), (*found)[0]) != 0) ++found;
    if (found == std::end(entities)) {
      result += text[at++];
    } else {
      result += (*found)[1];
      at += (*found)[0].size();
    }
  }
  return result;
}

}  // namespace seam
