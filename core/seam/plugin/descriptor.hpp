// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace seam {

/// Changes when a plugin must be rebuilt (major), or when something is added that older plugins do not miss
/// (minor). Which public headers go with a number, abi.txt in this folder says by a hash, which
/// tools/headers.py writes there.
inline constexpr std::uint16_t plugin_abi_major = 20;
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

}  // namespace seam
