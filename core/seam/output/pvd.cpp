// SPDX-License-Identifier: BSD-3-Clause
#include "seam/output/pvd.hpp"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "seam/base/diagnostics.hpp"
#include "seam/mesh/input/read_text.hpp"
#include "seam/mesh/input/vtu_xml.hpp"
#include "seam/output/atomic_file.hpp"
#include "seam/output/xml_escape.hpp"

namespace seam {

PvdSeries PvdSeries::resume(const std::string& path, double last_time) {
  PvdSeries series(path);
  if (!std::filesystem::exists(path)) return series;
  const std::string text = read_text(path);
  const auto tags = scan_vtk_xml(text, path);
  if (tags.empty() || tags[0].name != "VTKFile" || tags.back().name != "/VTKFile")
    throw Error(Location{path}, "this is not a complete .pvd file; remove it to start a new one");
  for (const XmlTag& tag : tags) {
    if (tag.name != "DataSet") continue;
    const auto time = tag.attributes.find("timestep"), file = tag.attributes.find("file");
    double value = 0;
    if (time == tag.attributes.end() || file == tag.attributes.end() ||
        std::from_chars(time->second.data(), time->second.data() + time->second.size(), value).ec !=
            std::errc())
      throw Error(Location{path, tag.line, 0},
                  "this entry has no time or no file; remove the .pvd file to start a "
                  "new one");
    if (value <= last_time) series.entries_.emplace_back(value, xml_unescape(file->second));
  }
  return series;
}

void PvdSeries::add(double time, const std::string& file) {
  // A run that is resumed may write the state it starts from once more.
  if (!entries_.empty() && entries_.back().first == time) entries_.pop_back();
  entries_.emplace_back(time, file);
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  // fmt's shortest form reads back to the same bits, so that a restart finds its own time.
  for (const auto& [t, name] : entries_)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", t, xml_escape(name));
  write_text_atomically(path_, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace seam
