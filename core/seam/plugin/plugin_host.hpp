// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "seam/base/diagnostics.hpp"
#include "seam/plugin/plugin_info.hpp"
#include "seam/plugin/registry.hpp"

namespace seam {

/// Why one plugin cannot be used.
struct PluginFailure {
  std::string plugin;
  std::string file;  ///< the file tried, or the folders searched
  std::string found;
  std::string expected;
  std::string hint;

  [[nodiscard]] std::string text() const;
};

/// The failures of all plugins of a scene.
class PluginError : public Error {
 public:
  explicit PluginError(std::vector<PluginFailure> failures);
  /// The same, of plugins that are asked for somewhere.
  PluginError(const Location& where, std::vector<PluginFailure> failures);
  [[nodiscard]] const std::vector<PluginFailure>& failures() const { return failures_; }

 private:
  std::vector<PluginFailure> failures_;
};

/// Finds plugins (files `libseam_<name>.so`) and loads those a scene names. A loaded plugin stays in memory
/// until the process ends: what it has registered, and every object built from that, holds its code.
class PluginHost {
 public:
  /// A file on the search path that is called as a plugin is.
  struct Found {
    std::string name;
    std::filesystem::path file;
    PluginInfo info;
    std::string problem;  ///< why its descriptor cannot be read, or ""
    /// Files of the same name in other folders, which are not used.
    std::vector<std::filesystem::path> hidden = {};

    /// Why it cannot be used in this Seam, as far as its descriptor tells; "" when it can.
    [[nodiscard]] std::string why_not() const;
  };

  /// Searches these folders, in this order.
  explicit PluginHost(const std::vector<std::filesystem::path>& folders);
  /// The folder of the plugins that come with Seam (installed or in the build tree), then those that the
  /// environment variable SEAM_PLUGIN_PATH lists, separated by ':'.
  static PluginHost standard();

  /// Searches this folder, too, after the others.
  void add_folder(const std::filesystem::path& folder);
  [[nodiscard]] const std::vector<std::filesystem::path>& folders() const { return folders_; }
  /// Folders that are not searched, each with the reason.
  [[nodiscard]] const std::vector<std::string>& refused() const { return refused_; }

  /// All plugins on the search path, by name; of two with the same name the first one that can be used
  /// counts. Runs no code of theirs.
  [[nodiscard]] std::vector<Found> scan() const;

  /// Loads the named plugins and lets them register their types. Those already loaded are left alone.
  /// @throws PluginError with the failures of all of them; the registry then holds nothing of those that
  /// failed.
  void load(const std::vector<std::string>& names, Registry& registry);

  /// Name of a plugin on the search path that is not loaded and provides a type, or "".
  [[nodiscard]] std::string provider(const std::string& kind, const std::string& type) const;

  [[nodiscard]] const std::vector<Found>& loaded() const { return loaded_; }

 private:
  [[nodiscard]] bool is_loaded(const std::string& name) const;
  std::vector<std::filesystem::path> folders_;
  std::vector<std::string> refused_;
  std::vector<Found> loaded_;
};

}  // namespace seam
