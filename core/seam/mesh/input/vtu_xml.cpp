// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/input/vtu_xml.hpp"

#include <algorithm>

#include "seam/base/diagnostics.hpp"

namespace seam {

namespace {

/// The first character that the value of an attribute may not have, or npos. An entity begins with '&'.
std::size_t first_forbidden(std::string_view value) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto c = static_cast<unsigned char>(value[i]);
    if ((c < 0x20 && c != '\t' && c != '\r' && c != '\n') || c == '<') return i;
    if (c != '&') continue;
    const std::size_t end = value.find(';', i);
    if (end == value.npos || value.substr(i, end - i).find(' ') != value.npos) return i;
  }
  return value.npos;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

class Scanner {
 public:
  Scanner(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  std::vector<XmlTag> scan() {
    std::vector<XmlTag> tags;
    while (true) {
      advance(std::min(text_.find('<', at_), text_.size()));
      if (at_ == text_.size()) return tags;
      if (text_.substr(at_).starts_with("<?xml") && (declared_ || !tags.empty()))
        fail("the XML declaration stands within the file; expected it in front, and once");
      declared_ = declared_ || text_.substr(at_).starts_with("<?xml");
      if (skip("<!--", "-->") || skip("<?", "?>")) continue;
      bool closed = false;
      XmlTag tag = read_tag(closed);
      const bool appended = tag.name == "AppendedData" && !closed;
      tag.text = text_.substr(at_, appended ? text_.npos : text_.find('<', at_) - at_);
      if (!closed) nest(tag);
      if (appended && (open_.size() != 2 || open_[0] != "VTKFile"))
        fail("appended data begin within " +
             (open_.size() < 2 ? "nothing" : "<" + open_[open_.size() - 2] + ">") +
             "; expected them within <VTKFile>, behind </UnstructuredGrid>");
      tags.push_back(std::move(tag));
      if (closed) tags.push_back({"/" + tags.back().name, {}, {}, line_});
      if (appended) return tags;
    }
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(Location{name_, line_, 0}, message);
  }

  void advance(std::size_t to) {
    line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                         text_.begin() + static_cast<std::ptrdiff_t>(to), '\n'));
    at_ = to;
  }
  bool skip(std::string_view open, std::string_view close) {
    if (text_.substr(at_, open.size()) != open) return false;
    const std::size_t end = text_.find(close, at_ + open.size());
    if (end == text_.npos) fail("the XML ends in a comment or a declaration; the file seems to be truncated");
    advance(end + close.size());
    return true;
  }

  /// What is opened last is closed first: else a line is missing, or there twice.
  void nest(const XmlTag& tag) {
    if (!tag.name.starts_with('/')) {
      open_.push_back(tag.name);
      return;
    }
    if (open_.empty() || "/" + open_.back() != tag.name)
      throw Error(Location{name_, tag.line, 0},
                  "found <" + tag.name + ">; expected " +
                      (open_.empty() ? "nothing more" : "</" + open_.back() + ">") +
                      ": the file is broken; write it anew");
    open_.pop_back();
  }

  char peek() {
    if (at_ >= text_.size()) fail("the XML ends within a tag; the file seems to be truncated");
    return text_[at_];
  }
  void skip_blank() {
    while (is_blank(peek())) advance(at_ + 1);
  }
  std::string word() {
    const std::size_t from = at_;
    while (!is_blank(peek()) && peek() != '>' && peek() != '=' && !(peek() == '/' && at_ > from)) ++at_;
    std::string found(text_.substr(from, at_ - from));
    const auto forbidden = [](unsigned char c) {
      return c < 0x20 || c > 0x7e ||
             std::string_view("<&\"'").find(static_cast<char>(c)) != std::string_view::npos;
    };
    if (std::ranges::any_of(found, forbidden))
      fail("a name in this XML tag holds a character that no VTK file has there; the file is broken");
    return found;
  }

  /// Reads from '<' to behind '>'.
  XmlTag read_tag(bool& closed) {
    XmlTag tag;
    tag.line = line_;
    ++at_;
    tag.name = word();
    for (skip_blank(); peek() != '>'; skip_blank()) {
      if (peek() == '/') {
        closed = true;
        ++at_;
        continue;
      }
      const std::string key = word();
      skip_blank();
      if (key.empty() || peek() != '=') fail("this XML tag has an attribute without a value");
      ++at_;
      skip_blank();
      const char quote = peek();
      if (quote != '"' && quote != '\'') fail("the value of attribute '" + key + "' is not in quotes");
      const std::size_t end = text_.find(quote, at_ + 1);
      if (end == text_.npos) fail("the XML ends within an attribute; the file seems to be truncated");
      const std::string_view value = text_.substr(at_ + 1, end - at_ - 1);
      if (const std::size_t bad = first_forbidden(value); bad != value.npos)
        fail(std::string("the value of attribute '") + key + "' holds " +
             (value[bad] == '<' || value[bad] == '&' ? std::string("'") + value[bad] + "'"
                                                     : "a control character") +
             ", which XML does not allow there; the file is broken");
      if (!tag.attributes.emplace(key, value).second)
        fail("this XML tag has the attribute '" + key + "' twice");
      advance(end + 1);
    }
    ++at_;
    return tag;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::vector<std::string> open_;
  bool declared_ = false;
};

}  // namespace

std::vector<XmlTag> scan_vtk_xml(std::string_view text, const std::string& name) {
  return Scanner(text, name).scan();
}

}  // namespace seam
