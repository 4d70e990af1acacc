// SPDX-License-Identifier: BSD-3-Clause
#include "seam/scene/yaml_tree.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <set>
#include <sstream>
#include <string_view>

namespace seam {

const YamlNode* YamlNode::find(const std::string& key) const {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].scalar == key) return &items[i];
  }
  return nullptr;
}

YamlNode* YamlNode::find(const std::string& key) {
  return const_cast<YamlNode*>(static_cast<const YamlNode*>(this)->find(key));
}

std::string YamlNode::found() const {
  const std::string entries = fmt::format("{} {}", items.size(), items.size() == 1 ? "entry" : "entries");
  switch (kind) {
    case Kind::null:
      return "nothing";
    case Kind::scalar:
      return fmt::format("'{}'", scalar.size() > 60 ? scalar.substr(0, 57) + "..." : scalar);
    case Kind::sequence:
      return "a list of " + entries;
    case Kind::map:
      return "an object of " + entries;
  }
  return "";
}

namespace {

/// Offset of the first byte that does not continue valid UTF-8 text, or npos. Control characters do not
/// either.
std::size_t first_bad_byte(const std::string& s) {
  for (std::size_t i = 0; i < s.size();) {
    const auto c = static_cast<unsigned char>(s[i]);
    if ((c < 0x20 && c != '\n' && c != '\t' && c != '\r') || c == 0x7f) return i;
    const std::size_t length = c < 0x80                ? 1
                               : c >= 0xc2 && c < 0xe0 ? 2
                               : (c & 0xf0) == 0xe0    ? 3
                               : c >= 0xf0 && c < 0xf5 ? 4
                                                       : 0;
    if (length == 0 || i + length > s.size()) return i;
    unsigned code = length == 1 ? c : c & (0xffU >> (length + 1));
    for (std::size_t k = 1; k < length; ++k) {
      const auto next = static_cast<unsigned char>(s[i + k]);
      if ((next & 0xc0U) != 0x80U) return i;
      code = (code << 6U) | (next & 0x3fU);
    }
    const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    if (overlong || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return i;
    i += length;
  }
  return std::string::npos;
}

/// Whether UTF-8 text begins with a control character beyond ASCII, a line separator, or a mark that turns
/// the direction of writing.
bool is_invisible_control(std::string_view text) {
  if (text.size() < 2) return false;
  const auto second = static_cast<unsigned char>(text[1]);
  if (text[0] == '\xc2') return second < 0xa0;
  if (text[0] == '\xd8') return second == 0x9c;  // Arabic letter mark
  if (text.substr(0, 3) == "\xef\xbb\xbf") return true;
  if (text.size() < 3 || text[0] != '\xe2') return false;
  const auto third = static_cast<unsigned char>(text[2]);
  return (second == 0x80 && third >= 0xa8 && third <= 0xae) ||
         (second == 0x80 && (third == 0x8b || third == 0x8e || third == 0x8f)) ||
         (second == 0x81 && third >= 0xa6 && third <= 0xa9);
}

/// The text's own line and column, counted from 1.
Location place_of(const std::string& text, std::size_t offset, const std::string& name) {
  Location where{name, 1, 1};
  for (std::size_t i = 0; i < offset; ++i) {
    where.column = text[i] == '\n' ? 1 : where.column + 1;
    if (text[i] == '\n') ++where.line;
  }
  return where;
}

/// Builds the tree from yaml-cpp's events, so that limits hold while the text is read, not after.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& text, const std::string& name, const YamlLimits& limits)
      : file_(std::make_shared<const std::string>(name)), limits_(limits), text_(text) {
    lines_.push_back(0);
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1))
      lines_.push_back(at + 1);
  }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnAnchor(const YAML::Mark& mark, const std::string&) override { refuse(mark, "an anchor ('&')"); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { refuse(mark, "an alias ('*')"); }
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    add(make(YamlNode::Kind::null, mark, "", anchor));
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    YamlNode node = make(YamlNode::Kind::scalar, mark, tag, anchor);
    node.scalar = printable(value, mark);
    node.quoted = tag == "!";
    add(std::move(node));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(make(YamlNode::Kind::sequence, mark, tag, anchor));
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override {
    open(make(YamlNode::Kind::map, mark, tag, anchor));
    // In braces a word alone is a key without a value.
    is_block_.back() = style != YAML::EmitterStyle::Flow;
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override {
    find_duplicates(open_.back());
    close();
  }

  Diagnostics diagnostics;
  YamlNode root;

 private:
  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& what) const {
    throw Error(location(mark),
                what + " is not allowed in a scene; write the value out, or use `parameters` for numbers");
  }

  /// A value ends up in messages and logs: line breaks of long texts become spaces; other control characters,
  /// and those that turn the direction of writing, would let it forge lines there.
  [[nodiscard]] std::string printable(std::string text, const YAML::Mark& mark) const {
    std::size_t bad = first_bad_byte(text);
    for (std::size_t i = 0; i + 1 < text.size() && bad == std::string::npos; ++i)
      if (is_invisible_control(text.substr(i, 3))) bad = i;
    if (bad != std::string::npos)
      throw Error(location(mark),
                  fmt::format("found a control character, byte 0x{:02x}, in a value; expected text that "
                              "can be seen; remove it (or its escape, as \\e or \\u009b)",
                              static_cast<unsigned char>(text[bad])));
    for (char& c : text)
      if (c == '\n' || c == '\t' || c == '\r') c = ' ';
    return text;
  }

  [[nodiscard]] Location location(const YAML::Mark& mark) const {
    return {*file_, mark.line + 1, mark.column + 1};
  }

  YamlNode make(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) refuse(mark, "an anchor ('&')");
    if (!tag.empty() && tag != "?" && tag != "!") refuse(mark, "a tag ('!')");
    if (++count_ > limits_.nodes) {
      throw Error(location(mark),
                  fmt::format("the file holds more than {} values; meshes and tables belong in files "
                              "of their own",
                              limits_.nodes));
    }
    YamlNode node;
    node.kind = kind;
    node.file = file_;
    node.line = mark.line + 1;
    node.column = mark.column + 1;
    return node;
  }

  void open(YamlNode node) {
    if (static_cast<int>(open_.size()) >= limits_.depth) {
      throw Error(node.where(),
                  fmt::format("nested more than {} levels deep; no scene needs that", limits_.depth));
    }
    open_.push_back(std::move(node));
    is_block_.push_back(false);
  }

  void close() {
    YamlNode node = std::move(open_.back());
    open_.pop_back();
    is_block_.pop_back();
    add(std::move(node));
  }

  void add(YamlNode node) {
    if (open_.empty()) {
      root = std::move(node);
      return;
    }
    YamlNode& parent = open_.back();
    const bool is_key = parent.kind == YamlNode::Kind::map && parent.keys.size() == parent.items.size();
    if (is_key && node.kind != YamlNode::Kind::scalar) {
      throw Error(node.where(), fmt::format("found {} as a key; expected a word", node.found()));
    }
    // Programs that read YAML 1.1 take the key `on` for a truth value and write it back as one.
    if (is_key && (node.scalar == "true" || node.scalar == "True")) node.scalar = "on";
    if (!is_key && node.kind == YamlNode::Kind::null && is_block_.back()) require_colon(parent.keys.back());
    (is_key ? parent.keys : parent.items).push_back(std::move(node));
  }

  /// The parser takes a word at the end of a block for a key without a value: so ends a file that was cut
  /// short.
  void require_colon(const YamlNode& key) const {
    if (key.line < 1 || key.line > static_cast<int>(lines_.size())) return;
    const std::string_view rest = std::string_view(text_).substr(lines_[key.line - 1]);
    const std::string_view line = rest.substr(0, rest.find('\n'));
    const auto from = static_cast<std::size_t>(key.column) - 1;
    if (key.quoted || from > line.size() || !line.substr(from).starts_with(key.scalar)) return;
    if (line.substr(0, from).find('?') != line.npos) return;  // "? key" needs no colon
    const std::size_t next = line.find_first_not_of(" \t\r", from + key.scalar.size());
    if (next != line.npos && line[next] == ':') return;
    throw Error(key.where(),
                fmt::format("found the word {} where its block ends; expected '{}:', and a value; is "
                            "the file complete?",
                            key.found(), key.scalar));
  }

  void find_duplicates(const YamlNode& map) {
    std::map<std::string, const YamlNode*> first;
    for (const YamlNode& key : map.keys) {
      const auto [it, is_new] = first.emplace(key.scalar, &key);
      if (is_new) continue;
      diagnostics.error(key.where(),
                        fmt::format("key {} is given twice (first in line {}); remove one of them",
                                    key.found(), it->second->line));
    }
  }

  std::shared_ptr<const std::string> file_;
  YamlLimits limits_;
  const std::string& text_;
  std::vector<std::size_t> lines_;  ///< where each begins
  std::vector<YamlNode> open_;
  std::vector<bool> is_block_;  ///< of these, whether it is a map of lines
  std::size_t count_ = 0;
};

void check_text(const std::string& text, const std::string& name, const YamlLimits& limits) {
  if (text.size() > limits.bytes) {
    throw Error({name, 0, 0},
                fmt::format("the file has {} bytes, a scene may have at most {}; meshes and tables belong "
                            "in files of their own",
                            text.size(), limits.bytes));
  }
  for (std::size_t at = text.find('\r'); at != std::string::npos; at = text.find('\r', at + 1))
    if (text.substr(at, 2) != "\r\n")
      throw Error(place_of(text, at, name),
                  "found a carriage return (byte 0x0d) without a line feed behind it; expected lines that "
                  "end as on Unix "
                  "or Windows; save the file so, or remove it");
  const std::size_t bad = first_bad_byte(text);
  if (bad == std::string::npos) return;
  throw Error(place_of(text, bad, name),
              fmt::format("byte 0x{:02x} is no printable UTF-8 text; is this a scene file, saved as UTF-8?",
                          static_cast<unsigned char>(text[bad])));
}

}  // namespace

YamlNode parse_yaml(const std::string& text, const std::string& name, const YamlLimits& limits) {
  check_text(text, name, limits);
  TreeBuilder builder(text, name, limits);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    parser.HandleNextDocument(builder);
    TreeBuilder rest(text, name, limits);
    if (parser.HandleNextDocument(rest)) {
      throw Error(rest.root.where(), "a second YAML document starts here ('---'); a scene is one document");
    }
  } catch (const YAML::Exception& e) {
    throw Error({name, e.mark.is_null() ? 0 : e.mark.line + 1, e.mark.is_null() ? 0 : e.mark.column + 1},
                "not valid YAML: " + e.msg);
  }
  builder.diagnostics.throw_if_errors();
  return std::move(builder.root);
}

}  // namespace seam
