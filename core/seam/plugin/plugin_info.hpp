// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace seam {

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
