// SPDX-License-Identifier: BSD-3-Clause
#include "seam/plugin/plugin_host.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>

#include "seam/plugin/descriptor.hpp"

namespace seam {

namespace {

namespace fs = std::filesystem;
using Declare = void (*)(Registry&);

std::string library_name(const std::string& plugin) { return "libseam_" + plugin + ".so"; }

/// The plugin's name in "libseam_<name>.so", or "".
std::string plugin_name(const fs::path& file) {
  const std::string name = file.filename().string(), start = "libseam_", end = ".so";
  if (name.size() <= start.size() + end.size() || !name.starts_with(start) || !name.ends_with(end)) return "";
  const std::string middle = name.substr(start.size(), name.size() - start.size() - end.size());
  // What is no name ends up in no message.
  const auto may_stand = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
  };
  return std::ranges::all_of(middle, may_stand) ? middle : "";
}

/// Whoever can change Seam itself needs no plugin for it: root, this user, and the owner of this library.
bool is_trusted(uid_t user) {
  static const uid_t owner = [] {
    Dl_info info{};
    struct stat status {};
    const bool is_known = dladdr(reinterpret_cast<const void*>(&host_fingerprint), &info) != 0 &&
                          info.dli_fname && stat(info.dli_fname, &status) == 0;
    return is_known ? status.st_uid : 0;
  }();
  return user == 0 || user == geteuid() || user == owner;
}

/// Why others than those may change what stands at a path, or "". Links are not followed.
std::string insecurity(const fs::path& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) return "it cannot be looked at";
  if (!is_trusted(status.st_uid)) return fmt::format("it belongs to another user (number {})", status.st_uid);
  // Permissions of a link mean nothing: what it leads to counts, and the folder that it stands in.
  if (S_ISLNK(status.st_mode)) return "";
  // Root's mark that only the owner of an entry may replace it.
  const bool is_sticky = S_ISDIR(status.st_mode) && (status.st_mode & S_ISVTX) != 0;
  if ((status.st_mode & S_IWOTH) != 0 && !is_sticky) return "everybody may write to it";
  // The group of a user alone has the user's number.
  const bool is_shared = status.st_gid != 0 && status.st_gid != geteuid() && status.st_gid != status.st_uid;
  if ((status.st_mode & S_IWGRP) != 0 && is_shared && !is_sticky)
    return fmt::format("a group of users (number {}) may write to it", status.st_gid);
  return "";
}

/// The first of a path and the folders above it that others may change, and why; or "".
std::string insecurity_on_the_way(const fs::path& path) {
  for (fs::path at = path; at.has_relative_path(); at = at.parent_path()) {
    const std::string reason = insecurity(at);
    if (!reason.empty()) return at == path ? reason : fmt::format("'{}' above it: {}", at.string(), reason);
  }
  return "";
}

/// The same of a library that lies in a folder which has been judged, or of what a link there leads to.
std::string insecurity_of_library(const fs::path& file) {
  std::error_code code;
  const fs::path real = fs::canonical(file, code);
  if (code) return "it leads nowhere";
  return real.parent_path() == file.parent_path() ? insecurity(real) : insecurity_on_the_way(real);
}

/// Why plugins are not taken from this folder, or "".
/// @param real without links
std::string refusal(const fs::path& folder, const fs::path& real) {
  static const std::set<std::string> system{"/lib",
                                            "/lib64",
                                            "/usr/lib",
                                            "/usr/lib64",
                                            "/usr/local/lib",
                                            "/usr/lib/x86_64-linux-gnu",
                                            "/usr/lib/aarch64-linux-gnu"};
  if (system.count(real.string()) > 0) return "a folder of the system; put plugins in one of their own";
  struct stat status {};
  if (stat(real.c_str(), &status) == 0 && (status.st_mode & S_IWOTH) != 0)
    return "everybody may write to it; use `chmod o-w`, if you trust what is in it";
  // The way as it is written counts, too: whoever may change a link decides what is found.
  const fs::path written = fs::absolute(folder).lexically_normal();
  for (const fs::path& way : {real, written.has_filename() ? written : written.parent_path()})
    if (const std::string reason = insecurity_on_the_way(way); !reason.empty())
      return fmt::format("{}; put plugins where only you (or root) may write, on all of the way to them",
                         reason);
  return "";
}

/// Folders next to the library (or program) that this code is in: lib/seam/plugins when installed,
/// lib/plugins in the build tree.
std::vector<fs::path> own_folders() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&host_fingerprint), &info) == 0 || !info.dli_fname) return {};
  std::error_code code;
  const fs::path self = fs::canonical(info.dli_fname, code);
  if (code) return {};
  const fs::path here = self.parent_path();
  return {here / "seam/plugins", here / "plugins", here / "../lib/seam/plugins", here / "../lib/plugins"};
}

/// What is wrong with a descriptor, judged without loading the plugin.
std::optional<PluginFailure> incompatible(const PluginHost::Found& plugin) {
  const PluginInfo& info = plugin.info;
  PluginFailure failure{plugin.name, plugin.file.string(), plugin.problem, "", ""};
  if (!plugin.problem.empty()) {
    failure.expected = "a shared library built with seam_add_plugin() and SEAM_PLUGIN()";
    failure.hint = "build the plugin again, or remove the file";
  } else if (info.abi_major != plugin_abi_major || info.abi_minor > plugin_abi_minor) {
    failure.found = fmt::format("plugin ABI {}.{}", info.abi_major, info.abi_minor);
    failure.expected =
        fmt::format("plugin ABI {}.0 to {}.{}", plugin_abi_major, plugin_abi_major, plugin_abi_minor);
    failure.hint = info.abi_major < plugin_abi_major
                       ? "build the plugin against this Seam"
                       : "use the newer Seam it was built for, or build it against this one";
  } else if (info.name != plugin.name) {
    failure.found = fmt::format("a plugin called '{}'", info.name);
    failure.expected = fmt::format("a plugin called '{}', as the file", plugin.name);
    failure.hint = fmt::format("rename the file to {}", library_name(info.name));
  } else if (info.fingerprint != host_fingerprint()) {
    failure.found = "built with " + fingerprint_difference(info.fingerprint, host_fingerprint());
    failure.expected = host_fingerprint();
    failure.hint = "build the plugin with the compiler and the libraries of this Seam";
  } else if (info.abi_minor == plugin_abi_minor && info.headers != host_headers()) {
    failure.found = fmt::format("built against other headers of the same version (their hash: {})",
                                info.headers.empty() ? "none" : info.headers);
    failure.expected = fmt::format("headers with the hash {}", host_headers());
    failure.hint = "build the plugin again against the headers that were installed with this Seam";
  } else if (const std::string reason = insecurity_of_library(plugin.file); !reason.empty()) {
    failure.found = "a file that others may change: " + reason;
    failure.expected = "a file that belongs to you or to root, and that only its owner can change";
    failure.hint = "if you trust its content, copy it to a folder of your own, or use `chmod o-w` on it";
  } else {
    return {};
  }
  return failure;
}

std::optional<PluginFailure> missing_dependency(const PluginHost::Found& plugin,
                                                const std::set<std::string>& present) {
  for (const std::string& required : plugin.info.required_plugins) {
    if (present.count(required) > 0) continue;
    return PluginFailure{plugin.name, plugin.file.string(),
                         fmt::format("required plugin '{}' is not loaded", required),
                         fmt::format("'{}' requires the plugins {}", plugin.name,
                                     fmt::join(plugin.info.required_plugins, ", ")),
                         fmt::format("add '{}' to `plugins` of the scene", required)};
  }
  return {};
}

/// dlerror() without the path it starts with, which the failure names already.
std::string loader_message(const fs::path& file) {
  const char* raw = dlerror();
  std::string message = raw ? raw : "unknown reason";
  const std::string start = file.string() + ": ";
  return message.starts_with(start) ? message.substr(start.size()) : message;
}

PluginFailure not_found(const std::string& name, const PluginHost& host) {
  std::vector<std::string> known, searched;
  for (const PluginHost::Found& found : host.scan()) known.push_back(found.name);
  for (const fs::path& folder : host.folders()) searched.push_back(folder.string());
  for (const std::string& refused : host.refused()) searched.push_back(refused);
  const std::string guess = nearest_name(name, known);
  std::string hint = !guess.empty() ? fmt::format("did you mean '{}'?", guess)
                     : host.refused().empty()
                         ? "set SEAM_PLUGIN_PATH to the folder that holds it"
                         : "if it lies in a folder that is not searched, do as is said there; else set "
                           "SEAM_PLUGIN_PATH to the folder that holds it";
  return {name,
          fmt::format(
              "{}", searched.empty() ? "no folder to search" : fmt::format("{}", fmt::join(searched, ", "))),
          known.empty() ? "no plugin at all" : fmt::format("the plugins {}", fmt::join(known, ", ")),
          library_name(name), hint};
}

/// The types a plugin has registered against those its descriptor promises.
std::optional<PluginFailure> broken_promise(const PluginHost::Found& plugin, const Registry& registry) {
  std::vector<std::string> missing, extra;
  for (const auto& [kind, type] : plugin.info.provides) {
    const Registry::Entry* entry = registry.find(kind, type);
    if (!entry || entry->plugin != plugin.name) missing.push_back(kind + ":" + type);
  }
  for (const Registry::Entry& entry : registry.entries()) {
    if (entry.plugin == plugin.name && !plugin.info.provides_type(entry.kind, entry.name)) {
      extra.push_back(entry.kind + ":" + entry.name);
    }
  }
  if (missing.empty() && extra.empty()) return {};
  std::string found;
  if (!missing.empty()) found = fmt::format("it does not register {}", fmt::join(missing, ", "));
  if (!extra.empty())
    found += fmt::format("{}it registers {}", found.empty() ? "" : "; ", fmt::join(extra, ", "));
  return PluginFailure{plugin.name, plugin.file.string(), found, "exactly the types its descriptor lists",
                       "correct PROVIDES of seam_add_plugin()"};
}

std::optional<PluginFailure> load_one(const PluginHost::Found& plugin, Registry& registry) {
  PluginFailure failure{plugin.name, plugin.file.string(), "", "", ""};
  void* library = dlopen(plugin.file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    failure.found = loader_message(plugin.file);
    failure.expected = "a library whose symbols and libraries are all there";
    failure.hint = "link what it uses, and do not use what is not in Seam's installed headers";
    return failure;
  }
  const auto declare = reinterpret_cast<Declare>(dlsym(library, "seam_plugin_declare"));
  if (!declare) {
    failure.found = "no symbol seam_plugin_declare";
    failure.expected = "the function that SEAM_PLUGIN() defines";
    failure.hint = "write SEAM_PLUGIN(registry) { ... } in one source file, and do not hide the symbol";
    return failure;
  }
  registry.set_current_plugin(plugin.name);
  try {
    declare(registry);
  } catch (const std::exception& e) {
    failure.found = fmt::format("its registration failed: {}", e.what());
  } catch (...) {
    failure.found = "its registration failed with an exception of an unknown type";
  }
  registry.set_current_plugin("core");
  if (!failure.found.empty()) {
    failure.expected = "a registration that adds types and returns";
    failure.hint = "this is an error of the plugin (or of two that do not go together); tell its author";
    return failure;
  }
  return broken_promise(plugin, registry);
}

}  // namespace

std::string PluginFailure::text() const {
  return fmt::format(
      "plugin '{}' cannot be used\n  tried:    {}\n  found:    {}\n  expected: {}\n  hint:     {}", plugin,
      file, found, expected, hint);
}

namespace {
std::string text_of_all(const std::vector<PluginFailure>& failures) {
  std::string result;
  for (const PluginFailure& failure : failures) result += (result.empty() ? "" : "\n") + failure.text();
  return result;
}
}  // namespace

PluginError::PluginError(std::vector<PluginFailure> failures)
    : Error(text_of_all(failures)), failures_(std::move(failures)) {}

PluginError::PluginError(const Location& where, std::vector<PluginFailure> failures)
    : Error(where, "plugins: " + text_of_all(failures)), failures_(std::move(failures)) {}

std::string PluginHost::Found::why_not() const {
  const auto failure = incompatible(*this);
  return failure ? fmt::format("found {}; expected {}; {}", failure->found, failure->expected, failure->hint)
                 : "";
}

PluginHost::PluginHost(const std::vector<std::filesystem::path>& folders) {
  for (const fs::path& folder : folders) add_folder(folder);
}

PluginHost PluginHost::standard() {
  PluginHost host(own_folders());
  const char* variable = std::getenv("SEAM_PLUGIN_PATH");
  std::string rest = variable ? variable : "";
  while (!rest.empty()) {
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    if (colon > 0) host.add_folder(rest.substr(0, colon));
    rest.erase(0, colon + 1);
  }
  return host;
}

void PluginHost::add_folder(const std::filesystem::path& folder) {
  std::error_code code;
  const fs::path real = fs::canonical(folder, code);
  if (code || !fs::is_directory(real, code)) return;
  if (std::find(folders_.begin(), folders_.end(), real) != folders_.end()) return;
  const std::string reason = refusal(folder, real);
  if (reason.empty()) {
    folders_.push_back(real);
  } else {
    refused_.push_back(fmt::format("{} (not searched: {})", real.string(), reason));
  }
}

std::vector<PluginHost::Found> PluginHost::scan() const {
  std::map<std::string, Found> result;
  for (const fs::path& folder : folders_) {
    std::error_code code;
    for (auto it = fs::directory_iterator(folder, code); !code && it != fs::directory_iterator();
         it.increment(code)) {
      const std::string name = plugin_name(it->path());
      if (name.empty()) continue;
      Found found{name, it->path(), {}, ""};
      try {
        found.info = read_descriptor(found.file);
      } catch (const Error& e) {
        found.problem = e.what();
      }
      const auto [known, is_new] = result.try_emplace(name, found);
      if (is_new) continue;
      // A stale one must not hide one that can be used.
      if (!known->second.why_not().empty() && found.why_not().empty()) {
        found.hidden = std::move(known->second.hidden);
        std::swap(found, known->second);
      }
      known->second.hidden.push_back(found.file);
    }
  }
  std::vector<Found> list;
  for (auto& [name, found] : result) list.push_back(std::move(found));
  return list;
}

bool PluginHost::is_loaded(const std::string& name) const {
  return std::any_of(loaded_.begin(), loaded_.end(), [&](const Found& f) { return f.name == name; });
}

std::string PluginHost::provider(const std::string& kind, const std::string& type) const {
  for (const Found& found : scan()) {
    if (!is_loaded(found.name) && found.info.provides_type(kind, type)) return found.name;
  }
  return "";
}

void PluginHost::load(const std::vector<std::string>& names, Registry& registry) {
  const std::vector<Found> found = scan();
  std::vector<PluginFailure> failures;
  std::vector<Found> wanted;
  std::set<std::string> present;
  for (const Found& plugin : loaded_) present.insert(plugin.name);
  for (const std::string& name : names) {
    if (!present.insert(name).second) continue;
    const auto it = std::find_if(found.begin(), found.end(), [&](const Found& f) { return f.name == name; });
    if (it == found.end()) {
      failures.push_back(not_found(name, *this));
    } else if (const auto failure = incompatible(*it)) {
      failures.push_back(*failure);
    } else {
      wanted.push_back(*it);
    }
  }
  for (const Found& plugin : wanted) {
    auto failure = missing_dependency(plugin, present);
    if (!failure) failure = load_one(plugin, registry);
    if (failure) {
      registry.remove_plugin(plugin.name);
      failures.push_back(*failure);
    } else {
      loaded_.push_back(plugin);
    }
  }
  if (!failures.empty()) throw PluginError(std::move(failures));
}

}  // namespace seam
