// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "seam/base/diagnostics.hpp"
#include "seam/mesh/input/text_reader.hpp"
#include "seam/mesh/input/vtu_data.hpp"
#include "seam/mesh/input/vtu_file.hpp"
#include "seam/mesh/input/vtu_xml.hpp"

namespace seam {

namespace {

template <class T>
void convert(const std::vector<unsigned char>& bytes, std::vector<double>& values) {
  values.resize(bytes.size() / sizeof(T));
  for (std::size_t i = 0; i < values.size(); ++i) {
    T value;
    std::memcpy(&value, &bytes[i * sizeof(T)], sizeof(T));
    values[i] = static_cast<double>(value);
  }
}

struct NumberType {
  const char* name;
  std::size_t bytes;
  void (*convert)(const std::vector<unsigned char>&, std::vector<double>&);
};
constexpr NumberType number_types[] = {
    {"Int8", 1, convert<std::int8_t>},   {"UInt8", 1, convert<std::uint8_t>},
    {"Int16", 2, convert<std::int16_t>}, {"UInt16", 2, convert<std::uint16_t>},
    {"Int32", 4, convert<std::int32_t>}, {"UInt32", 4, convert<std::uint32_t>},
    {"Int64", 8, convert<std::int64_t>}, {"UInt64", 8, convert<std::uint64_t>},
    {"Float32", 4, convert<float>},      {"Float64", 8, convert<double>},
};

/// Whether text ends with a word, which is then removed, as is white space behind it.
bool remove_end(std::string_view& text, std::string_view word) {
  text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
  if (!text.ends_with(word)) return false;
  text.remove_suffix(word.size());
  return true;
}

class Parser {
 public:
  Parser(const std::string& text, const std::string& name) : text_(text), name_(name) {}

  VtuFile parse() {
    const std::vector<XmlTag> tags = scan_vtk_xml(text_, name_);
    if (tags.empty() || tags[0].name != "VTKFile")
      fail(1, "the file does not start with <VTKFile>, so it is not a VTK XML file");
    file_tag(tags[0]);
    if (tags.back().name == "AppendedData") appended_data(tags.back());
    // What is appended may hold anything, so that tags behind it are not read.
    std::string_view rest(text_);
    if (!remove_end(rest, "</VTKFile>") || (has_appended_ && !remove_end(rest, "</AppendedData>")))
      fail(tags.back().line, fmt::format("the file ends without {}</VTKFile>; it seems to be truncated",
                                         has_appended_ ? "</AppendedData>" : ""));
    std::string section;
    bool piece = false;
    for (const XmlTag& tag : tags) {
      if (tag.name == "Piece") {
        if (piece)
          fail(tag.line,
               "the file has several pieces; expected one (merge them, as ParaView's 'Merge Blocks')");
        piece = true;
        file_.points = count(tag, "NumberOfPoints");
        file_.cells = count(tag, "NumberOfCells");
      } else if (tag.name == "Points" || tag.name == "Cells" || tag.name == "PointData" ||
                 tag.name == "CellData") {
        section = tag.name;
      } else if (tag.name == "DataArray" || tag.name == "Array") {
        data_array(tag, section, piece);
      } else if (tag.name == "/" + section) {
        section.clear();
      }
    }
    if (!piece) fail(tags.back().line, "the file has no <Piece>; expected one");
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& message) const {
    throw Error(Location{name_, line, 0}, message);
  }

  [[nodiscard]] static std::string attribute(const XmlTag& tag, const char* key, const char* otherwise = "") {
    const auto found = tag.attributes.find(key);
    return found == tag.attributes.end() ? otherwise : found->second;
  }

  /// A number of things of which a file of this size can have that many, even compressed.
  [[nodiscard]] std::size_t count(const XmlTag& tag, const char* key, const char* otherwise = "") const {
    const std::string word = attribute(tag, key, otherwise);
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || word.empty())
      fail(tag.line,
           fmt::format("{} is '{}' in <{}>; expected a whole number", key, word.substr(0, 40), tag.name));
    constexpr std::size_t best_compression = 1040;
    if (value > std::min<std::size_t>(text_.size() * best_compression, std::numeric_limits<int>::max()))
      fail(tag.line,
           fmt::format("{} is {}, more than a file of {} bytes can hold", key, value, text_.size()));
    return value;
  }

  void file_tag(const XmlTag& tag) {
    if (const auto type = attribute(tag, "type"); type != "UnstructuredGrid")
      fail(tag.line,
           fmt::format("the file holds VTK data of type '{}'; expected UnstructuredGrid (.vtu)", type));
    if (attribute(tag, "byte_order", "LittleEndian") != "LittleEndian")
      fail(tag.line, "the file is big-endian; expected byte_order LittleEndian");
    const std::string header = attribute(tag, "header_type", "UInt32"),
                      compressor = attribute(tag, "compressor");
    if (header != "UInt32" && header != "UInt64")
      fail(tag.line, fmt::format("header_type is '{}'; expected UInt32 or UInt64", header));
    encoding_.header_bytes = header == "UInt32" ? 4 : 8;
    if (compressor == "vtkZLibDataCompressor")
      encoding_.compressor = VtuEncoding::Compressor::zlib;
    else if (compressor == "vtkLZ4DataCompressor")
      encoding_.compressor = VtuEncoding::Compressor::lz4;
    else if (!compressor.empty())
      fail(tag.line,
           fmt::format("the file is compressed by '{}'; expected ZLib, LZ4 or no compression", compressor));
  }

  void appended_data(const XmlTag& tag) {
    const std::string encoding = attribute(tag, "encoding");
    if (encoding != "raw" && encoding != "base64")
      fail(tag.line, fmt::format("appended data have encoding '{}'; expected raw or base64", encoding));
    appended_base64_ = encoding == "base64";
    const std::size_t mark = tag.text.find('_');
    if (mark == tag.text.npos) fail(tag.line, "appended data do not start with '_'");
    appended_ = tag.text.substr(mark + 1);
    has_appended_ = true;
  }

  void data_array(const XmlTag& tag, const std::string& section, bool in_piece) {
    const std::string array = section == "Points" ? "" : attribute(tag, "Name");
    const bool wanted =
        section == "Points" || section == "Cells" || (section == "CellData" && array == "region");
    if (!wanted || !in_piece) return;
    VtuFile::Array result;
    const std::size_t components = count(tag, "NumberOfComponents", "1");
    if (components < 1 || components > 9)
      fail(tag.line, fmt::format("array '{}' has {} components; expected 1 to 9", array, components));
    result.components = static_cast<int>(components);
    const std::size_t size = section == "Points"                             ? file_.points * components
                             : section == "Cells" && array == "connectivity" ? any_size
                                                                             : file_.cells * components;
    const std::string shown = array.empty() ? section : array;
    if (attribute(tag, "type") == "String")
      result.words = words(tag, shown);
    else
      result.values = numbers(tag, shown, size);
    if (!file_.arrays.emplace(std::pair(section, array), std::move(result)).second)
      fail(tag.line, fmt::format("there is a second array '{}' in {}", shown, section));
  }

  std::vector<double> numbers(const XmlTag& tag, const std::string& array, std::size_t size) const {
    const std::string type = attribute(tag, "type");
    const auto* known = std::find_if(std::begin(number_types), std::end(number_types),
                                     [&](const NumberType& t) { return type == t.name; });
    if (known == std::end(number_types))
      fail(tag.line,
           fmt::format("array '{}' has type '{}'; expected Int8 to UInt64, Float32 or Float64", array, type));
    std::vector<double> values;
    if (attribute(tag, "format") == "ascii")
      values = ascii(tag, array);
    else
      known->convert(bytes(tag, array, size == any_size ? any_size : size * known->bytes), values);
    if (size != any_size && values.size() != size)
      fail(tag.line, fmt::format("array '{}' has {} values; expected {}", array, values.size(), size));
    return values;
  }

  std::vector<double> ascii(const XmlTag& tag, const std::string& array) const {
    std::vector<double> values;
    TextReader in(tag.text, name_);
    try {
      while (!in.at_end()) values.push_back(in.number("a value"));
    } catch (const Error&) {
      fail(tag.line, fmt::format("array '{}' holds something that is not a finite number", array));
    }
    return values;
  }

  std::vector<unsigned char> bytes(const XmlTag& tag, const std::string& array, std::size_t expected) const {
    const std::string format = attribute(tag, "format");
    try {
      if (format == "binary") return decode_vtu_data(tag.text, true, encoding_, expected);
      if (format != "appended")
        fail(tag.line,
             fmt::format("array '{}' has format '{}'; expected ascii, binary or appended", array, format));
      const std::size_t offset = count(tag, "offset");
      if (!has_appended_ || offset >= appended_.size())
        fail(tag.line,
             fmt::format("array '{}' is at offset {} of the appended data, which have {} bytes; the file is "
                         "truncated or broken",
                         array, offset, appended_.size()));
      return decode_vtu_data(appended_.substr(offset), appended_base64_, encoding_, expected);
    } catch (const VtuDataError& e) {
      fail(tag.line, fmt::format("array '{}' {}", array, e.what()));
    }
  }

  /// Strings are stored as characters (their codes in ASCII), each string ended by a zero.
  std::vector<std::string> words(const XmlTag& tag, const std::string& array) const {
    std::vector<double> codes;
    if (attribute(tag, "format") == "ascii")
      codes = ascii(tag, array);
    else
      convert<std::uint8_t>(bytes(tag, array, any_size), codes);
    std::vector<std::string> result;
    std::string current;
    for (const double code : codes) {
      if (code < 0 || code > 255)
        fail(tag.line, fmt::format("array '{}' holds {} as a character", array, code));
      if (code != 0)
        current += static_cast<char>(static_cast<unsigned char>(code));
      else
        result.push_back(std::exchange(current, {}));
    }
    if (result.size() != file_.cells)
      fail(tag.line,
           fmt::format("array '{}' has {} strings; expected {}", array, result.size(), file_.cells));
    return result;
  }

  const std::string& text_;
  const std::string& name_;
  VtuFile file_;
  VtuEncoding encoding_;
  std::string_view appended_;
  bool has_appended_ = false, appended_base64_ = false;
};

}  // namespace

VtuFile parse_vtu(const std::string& text, const std::string& name) { return Parser(text, name).parse(); }

}  // namespace seam
