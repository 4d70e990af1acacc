// SPDX-License-Identifier: BSD-3-Clause
#include "seam/plugin/plugin_info.hpp"

#include <elf.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>

#include "seam/base/diagnostics.hpp"
#include "seam/plugin/descriptor.hpp"
#include "seam/plugin/fingerprint.hpp"
#include "seam/plugin/headers.hpp"

namespace seam {

namespace {

/// Copies a struct out of the bytes, if it lies within them.
template <class T>
std::optional<T> read_at(const std::string& bytes, std::uint64_t offset) {
  if (offset > bytes.size() || bytes.size() - offset < sizeof(T)) return {};
  T result;
  std::memcpy(&result, bytes.data() + offset, sizeof(T));
  return result;
}

template <class T>
T require_at(const std::string& bytes, std::uint64_t offset, const char* what) {
  if (const auto result = read_at<T>(bytes, offset)) return *result;
  throw Error(fmt::format("the file ends before its {}: it is truncated or damaged", what));
}

Elf64_Ehdr elf_header(const std::string& bytes) {
  if (bytes.size() < SELFMAG || std::memcmp(bytes.data(), ELFMAG, SELFMAG) != 0) {
    throw Error("not a shared library (no ELF file)");
  }
  const auto header = require_at<Elf64_Ehdr>(bytes, 0, "ELF header");
  if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_ident[EI_DATA] != ELFDATA2LSB) {
    throw Error("not a library of this machine (expected 64 bit, little endian)");
  }
  if (header.e_type != ET_DYN) throw Error("an ELF file, but not a shared library");
  return header;
}

/// The bytes of the section called `wanted`, or nothing.
std::optional<std::string> section(const std::string& bytes, const std::string& wanted) {
  const Elf64_Ehdr header = elf_header(bytes);
  if (header.e_shoff == 0 || header.e_shentsize != sizeof(Elf64_Shdr)) return {};
  const auto section_header = [&](std::uint64_t i) {
    // The sum may not wrap: e_shoff is any 64-bit number in a damaged file.
    if (header.e_shoff > bytes.size())
      throw Error("its section table lies beyond its end: it is truncated or damaged");
    return require_at<Elf64_Shdr>(bytes, header.e_shoff + i * sizeof(Elf64_Shdr), "section table");
  };
  // The table stands at the end: a file that is cut off lacks some of it.
  if (header.e_shnum > 0) static_cast<void>(section_header(header.e_shnum - 1));
  const Elf64_Shdr names = section_header(header.e_shstrndx);
  for (std::uint64_t i = 0; i < header.e_shnum; ++i) {
    const Elf64_Shdr entry = section_header(i);
    if (entry.sh_type == SHT_NOBITS || names.sh_offset > bytes.size()) continue;
    const std::uint64_t name = names.sh_offset + entry.sh_name;
    if (name > bytes.size() || bytes.size() - name <= wanted.size()) continue;
    if (std::memcmp(bytes.data() + name, wanted.c_str(), wanted.size() + 1) != 0) continue;
    if (entry.sh_offset > bytes.size() || bytes.size() - entry.sh_offset < entry.sh_size) {
      throw Error(fmt::format("its section {} reaches beyond its end: it is truncated or damaged", wanted));
    }
    return bytes.substr(entry.sh_offset, entry.sh_size);
  }
  return {};
}

/// A member of the descriptor as text: printable, up to its zero byte.
template <std::size_t n>
std::string text_of(const char (&member)[n], const char* what) {
  const char* end = std::find(member, member + n, '\0');
  if (end == member + n)
    throw Error(fmt::format("its descriptor's {} does not end: the file is damaged", what));
  const bool printable = std::all_of(member, end, [](char c) { return c >= 0x20 && c < 0x7f; });
  if (!printable)
    throw Error(fmt::format("its descriptor's {} is no readable text: the file is damaged", what));
  return {member, end};
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string word; stream >> word;) result.push_back(word);
  return result;
}

PluginInfo info_of(const PluginDescriptor& raw) {
  PluginInfo info;
  info.abi_major = raw.abi_major;
  info.abi_minor = raw.abi_minor;
  // Another major version may lay out what follows differently.
  if (info.abi_major != plugin_abi_major) return info;
  info.name = text_of(raw.name, "name");
  info.version = text_of(raw.version, "version");
  info.licence = text_of(raw.licence, "licence");
  info.fingerprint = text_of(raw.fingerprint, "fingerprint");
  info.headers = text_of(raw.headers, "hash of headers");
  info.required_plugins = words(text_of(raw.requires_plugins, "list of required plugins"));
  for (const std::string& word : words(text_of(raw.provides, "list of types"))) {
    const std::size_t colon = word.find(':');
    if (colon == std::string::npos)
      throw Error(fmt::format("its descriptor lists the type '{}'; expected 'kind:name'", word));
    info.provides.emplace_back(word.substr(0, colon), word.substr(colon + 1));
  }
  return info;
}

}  // namespace

bool PluginInfo::provides_type(const std::string& kind, const std::string& type) const {
  return std::find(provides.begin(), provides.end(), std::pair(kind, type)) != provides.end();
}

PluginInfo parse_descriptor(const std::string& bytes) {
  const std::optional<std::string> note = section(bytes, ".note.seam");
  if (!note) throw Error("a shared library without a plugin descriptor (no section .note.seam)");
  constexpr std::size_t start = offsetof(PluginNote, descriptor);
  // Only what every version has: magic, ABI and size.
  constexpr std::size_t common = offsetof(PluginDescriptor, name);
  if (note->size() < start + common) throw Error("its plugin descriptor is too short: the file is damaged");
  PluginDescriptor raw;
  const PluginDescriptor expected;
  std::memcpy(static_cast<void*>(&raw), note->data() + start, common);
  if (std::memcmp(raw.magic, expected.magic, sizeof raw.magic) != 0) {
    throw Error("its section .note.seam holds no plugin descriptor (wrong magic)");
  }
  if (raw.abi_major == plugin_abi_major) {
    // An older minor version has fewer members, a newer one more.
    const std::size_t least = raw.abi_minor == 0 ? offsetof(PluginDescriptor, headers) : sizeof raw;
    const std::size_t present = std::min<std::size_t>(raw.size, note->size() - start);
    if (present < least)
      throw Error(fmt::format("its plugin descriptor has {} bytes, expected at least {}", present, least));
    std::memcpy(static_cast<void*>(&raw), note->data() + start, std::min(present, sizeof raw));
  }
  return info_of(raw);
}

PluginInfo read_descriptor(const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) throw Error("not a regular file");
  constexpr std::uintmax_t largest = std::uintmax_t{1} << 30;
  const std::uintmax_t size = std::filesystem::file_size(file, code);
  if (code || size > largest) throw Error("larger than a shared library can be (1 GiB)");
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(size, '\0');
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) throw Error("cannot be read");
  return parse_descriptor(bytes);
}

std::string host_headers() { return SEAM_HEADERS; }

std::string host_fingerprint() { return SEAM_FINGERPRINT; }

std::string fingerprint_difference(const std::string& found, const std::string& expected) {
  const std::vector<std::string> a = words(found), b = words(expected);
  std::string result;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    const std::string left = i < a.size() ? a[i] : "nothing", right = i < b.size() ? b[i] : "nothing";
    if (left != right) result += fmt::format("{}{} (expected {})", result.empty() ? "" : ", ", left, right);
  }
  return result;
}

}  // namespace seam
