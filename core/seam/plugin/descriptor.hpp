// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

// The macros of the fingerprint need a macro of the C++ library to be there.
#include "seam/plugin/fingerprint.hpp"

namespace seam {

/// Changes when a plugin must be rebuilt (major), or when something is added that older plugins do not miss
/// (minor). Which public headers go with a number, abi.txt in this folder says by a hash, which
/// tools/headers.py writes there.
inline constexpr std::uint16_t plugin_abi_major = 12;
inline constexpr std::uint16_t plugin_abi_minor = 0;

/// Describes a plugin without running any of its code: it lies in an ELF note section of the shared library
/// and is read from the file. Texts end with a zero byte. Later minor versions may append members.
struct PluginDescriptor {
  char magic[8] = {'S', 'E', 'A', 'M', 'P', 'L', 'U', 'G'};
  std::uint16_t abi_major = plugin_abi_major;
  std::uint16_t abi_minor = plugin_abi_minor;
  std::uint32_t size = 0;  ///< of this struct, in bytes
  char name[64] = "";
  char version[32] = "";
  char licence[64] = "";
  char requires_plugins[256] = "";  ///< names, separated by spaces
  char fingerprint[256] = "";       ///< SEAM_FINGERPRINT
  char provides[4096] = "";         ///< "kind:name" of each registered type, separated by spaces
  char headers[64] = "";            ///< SEAM_HEADERS, a hash of the public headers; since 9.1
};

/// An ELF note that holds a descriptor.
struct PluginNote {
  std::uint32_t name_size = 5;
  std::uint32_t descriptor_size = sizeof(PluginDescriptor);
  std::uint32_t type = 1;
  char name[8] = "Seam";
  PluginDescriptor descriptor;
};
static_assert(sizeof(PluginNote) == 20 + sizeof(PluginDescriptor), "ELF notes have no padding here");

/// A descriptor as read from a file.
struct PluginInfo {
  int abi_major = 0;
  int abi_minor = 0;
  std::string name;
  std::string version;
  std::string licence;
  std::string fingerprint;
  std::string headers;  ///< "" before ABI 9.1
  std::vector<std::string> required_plugins;
  std::vector<std::pair<std::string, std::string>> provides;  ///< kind, name

  [[nodiscard]] bool provides_type(const std::string& kind, const std::string& type) const;
};

/// Reads the descriptor of a shared library without loading it.
/// @throws Error saying what is wrong with the file; no file, however broken, does worse.
PluginInfo read_descriptor(const std::filesystem::path& file);

/// The same from the bytes of the file.
PluginInfo parse_descriptor(const std::string& bytes);

/// The fingerprint of this Seam.
std::string host_fingerprint();

/// The hash of this Seam's public headers.
std::string host_headers();

/// The parts in which two fingerprints differ: "trilinos=13.2 (expected 14.0)".
std::string fingerprint_difference(const std::string& found, const std::string& expected);

}  // namespace seam
