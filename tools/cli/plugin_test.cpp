// SPDX-License-Identifier: BSD-3-Clause
// seam plugin test: the conformance kit. What every plugin must hold, checked on the plugin alone and on
// scenes.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "command.hpp"
#include "rank_runs.hpp"
#include "seam/conformance/plugin_checks.hpp"
#include "seam/conformance/potential_checks.hpp"
#include "seam/conformance/scene_checks.hpp"
#include "session.hpp"

namespace seam::cli {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string file;
  std::vector<std::string> scenes;
  std::vector<int> ranks{1, 2, 3};
};

/// A folder of its own for the results, which goes away again.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "seam-plugin-test-XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw Error("cannot make a temporary folder '" + name + "'; set TMPDIR to a writable one");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// The plugin of a file, as a host that searches its folder first finds it.
PluginHost::Found find_plugin(const fs::path& file, PluginHost& host) {
  if (!fs::is_regular_file(file)) throw Error("error: there is no plugin file '" + file.string() + "'");
  const fs::path real = fs::canonical(file);
  host = PluginHost({real.parent_path()});
  const PluginHost standard = PluginHost::standard();
  for (const fs::path& folder : standard.folders()) host.add_folder(folder);
  for (const PluginHost::Found& found : host.scan())
    if (fs::canonical(found.file) == real) return found;
  throw Error(fmt::format(
      "error: '{}' is not found as a plugin: it must be called libseam_<name>.so and lie in a folder "
      "that only its owner may write to",
      file.string()));
}

/// Scenes that lie in conformance/<plugin> beside the plugin, where seam_add_plugin() puts them.
std::vector<std::string> scenes_beside(const PluginHost::Found& plugin) {
  std::vector<std::string> scenes;
  const fs::path folder = plugin.file.parent_path() / "conformance" / plugin.name;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".yaml") scenes.push_back(entry.path().string());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

/// Prints blocks of checks and remembers whether any failed.
class Report {
 public:
  void add(const std::string& subject, const std::vector<ConformanceCheck>& checks) {
    fmt::print("{}\n{}", subject, conformance_table(checks));
    std::fflush(stdout);
    for (const ConformanceCheck& check : checks) ++count_[static_cast<int>(check.outcome)];
  }
  [[nodiscard]] int finish() const {
    fmt::print("{} passed, {} failed, {} skipped\n", count_[0], count_[1], count_[2]);
    return count_[1] == 0 ? ok : failed;
  }

 private:
  int count_[3] = {0, 0, 0};
};

/// The children that mpirun starts must find the plugin, too.
void show_plugin_to_children(const fs::path& folder) {
  const char* old = std::getenv("SEAM_PLUGIN_PATH");
  setenv("SEAM_PLUGIN_PATH", (folder.string() + (old && *old ? std::string(":") + old : "")).c_str(), 1);
}

std::vector<ConformanceCheck> rank_checks(const PluginHost::Found& plugin, const std::string& scene,
                                          const Options& options, const fs::path& folder) {
  for (const PluginHost::Found& found : PluginHost::standard().scan())
    if (found.name == plugin.name && fs::canonical(found.file) != fs::canonical(plugin.file))
      return {conformance_check(
          "independence of the number of ranks", false,
          fmt::format("'{}', a plugin of the same name, is found first; remove it", found.file.string()))};
  return {run_on_ranks(scene, conformance_overrides(), options.ranks, folder)};
}

/// Everything on one scene that is done in this process.
std::vector<ConformanceCheck> scene_checks(const std::string& file, const PluginHost::Found& plugin,
                                           PluginHost& host, Registry& registry, const fs::path& folder,
                                           std::set<std::string>& used) {
  try {
    const Scene scene = load_scene(file, conformance_overrides(), host, registry);
    std::vector<ConformanceCheck> checks;
    for_each_typed(scene, registry, [&](const Registry::Entry& entry, const Parameters& parameters) {
      used.insert(entry.kind + ":" + entry.name);
      if (entry.plugin != plugin.name || entry.kind != "hyperelastic") return;
      const auto material = registry.create<Potential>(entry.kind, parameters);
      for (ConformanceCheck check : check_hyperelastic(*material)) {
        check.name = entry.name + ": " + check.name;
        checks.push_back(std::move(check));
      }
    });
    const auto more = check_scene(scene, registry, folder);
    checks.insert(checks.end(), more.begin(), more.end());
    return checks;
  } catch (const Error& error) {
    return {conformance_check("loads", false, error.what())};
  }
}

int run(const Options& options) {
  PluginHost host({});
  const PluginHost::Found plugin = find_plugin(options.file, host);
  show_plugin_to_children(plugin.file.parent_path());
  const TemporaryFolder folder;
  Registry registry = builtin_types();
  Report report;
  const auto alone = check_plugin(plugin, host, registry);
  report.add(fmt::format("plugin {} {}, {}", plugin.name, plugin.info.version, plugin.file.string()), alone);
  const bool loaded = std::any_of(host.loaded().begin(), host.loaded().end(),
                                  [&](const PluginHost::Found& found) { return found.name == plugin.name; });
  if (!loaded) return report.finish();

  const std::vector<std::string> scenes = options.scenes.empty() ? scenes_beside(plugin) : options.scenes;
  std::vector<std::vector<ConformanceCheck>> on_ranks;
  for (std::size_t k = 0; k < scenes.size(); ++k)
    on_ranks.push_back(rank_checks(plugin, scenes[k], options, folder.path() / std::to_string(k)));

  return run_on_all_ranks([&](bool) {
    std::set<std::string> used;
    for (std::size_t k = 0; k < scenes.size(); ++k) {
      auto checks = scene_checks(scenes[k], plugin, host, registry, folder.path() / std::to_string(k), used);
      checks.insert(checks.end(), on_ranks[k].begin(), on_ranks[k].end());
      report.add("scene " + scenes[k], checks);
    }
    report.add("coverage", check_coverage(plugin.info, used));
    return report.finish();
  });
}

}  // namespace

Command plugin_test_command(CLI::App& parent) {
  CLI::App* group = parent.add_subcommand("plugin", "Work on one plugin");
  group->require_subcommand(1);
  CLI::App* app = group->add_subcommand("test",
                                        "Check what every plugin must hold: descriptor, schemas, tangents "
                                        "against finite differences, rewind of a failed "
                                        "step, restart, independence of the number of ranks");
  auto options = std::make_shared<Options>();
  app->add_option("file", options->file, "the plugin, libseam_<name>.so")->required();
  app->add_option("--scene", options->scenes,
                  "scene that uses it; may be repeated; default those in conformance/<name> beside the file");
  app->add_option("--ranks", options->ranks, "numbers of ranks to compare; default 1,2,3")->delimiter(',');
  return {app, [options] { return run(*options); }};
}

}  // namespace seam::cli
