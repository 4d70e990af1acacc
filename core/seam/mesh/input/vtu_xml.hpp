// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace seam {

/// One opening tag of an XML file, with the text up to the next tag.
struct XmlTag {
  std::string name;  ///< with "/" in front for a closing tag
  std::map<std::string, std::string> attributes;
  std::string_view text;
  int line = 0;
};

/// The tags of a VTK XML file in their order. Stops behind <AppendedData>, whose text (everything to the end
/// of the file) may be binary. That is also why an ordinary XML parser does not serve.
/// @throws Error with file and line
std::vector<XmlTag> scan_vtk_xml(std::string_view text, const std::string& name);

}  // namespace seam
