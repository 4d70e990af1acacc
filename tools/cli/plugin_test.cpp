// SPDX-License-Identifier: BSD-3-Clause
// seam plugin test: the conformance kit. What every plugin must hold, checked on the plugin alone and on
// scenes.
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "all_ranks.hpp"
#include "command.hpp"
#include "common.hpp"
#include "rank_runs.hpp"
#include "seam/base/plugin_fault.hpp"
#include "seam/base/program.hpp"
#include "seam/conformance/plugin_checks.hpp"
#include "seam/conformance/potential_checks.hpp"
#include "seam/conformance/scene_checks.hpp"

namespace seam::cli {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string file;
  std::vector<std::string> scenes;
  std::vector<int> ranks{1, 2, 3};
  // Of a child:
  std::string child;     ///< the file that gets what it finds; empty: not one
  std::string work;      ///< its folder
  bool compare = false;  ///< the runs on several ranks, which are in that folder
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

/// Why runs on several ranks cannot be compared, if they cannot.
std::optional<ConformanceCheck> run_ranks(const PluginHost::Found& plugin, const std::string& scene,
                                          const Options& options, const fs::path& folder) {
  for (const PluginHost::Found& found : PluginHost::standard().scan())
    if (found.name == plugin.name && fs::canonical(found.file) != fs::canonical(plugin.file))
      return conformance_check(
          "independence of the number of ranks", false,
          fmt::format("'{}', a plugin of the same name, is found first; remove it", found.file.string()));
  return run_on_ranks(scene, conformance_overrides(plugin.info), options.ranks, folder);
}

// The plugin's code runs in children of this process alone: a crash there is one more finding. What a child
// has found, it leaves in a file, a line each: {"begins": what}, {"used": "kind:type"}, {"name", "outcome",
// "figures"}.

/// What a child has found.
struct Findings {
  std::vector<ConformanceCheck> checks;
  std::set<std::string> used;
  std::string last;  ///< what it had begun when it ended
};

/// Writes the lines, in a child.
class Record {
 public:
  explicit Record(const fs::path& file) : file_(file, std::ios::app) {}
  void begin(const std::string& what) { write({{"begins", what}}); }
  void use(const std::string& type) { write({{"used", type}}); }
  void add(const std::vector<ConformanceCheck>& checks) {
    for (const ConformanceCheck& c : checks)
      write({{"name", c.name}, {"outcome", static_cast<int>(c.outcome)}, {"figures", c.figures}});
  }

 private:
  void write(const nlohmann::json& line) {
    file_ << line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
  }
  std::ofstream file_;
};

Findings read_findings(const fs::path& file) {
  Findings findings;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const nlohmann::json entry = nlohmann::json::parse(line);
    if (entry.contains("begins"))
      findings.last = entry["begins"];
    else if (entry.contains("used"))
      findings.used.insert(entry["used"].get<std::string>());
    else
      findings.checks.push_back({entry["name"],
                                 static_cast<ConformanceCheck::Outcome>(entry["outcome"].get<int>()),
                                 entry["figures"]});
  }
  return findings;
}

/// Everything on the plugin without a scene, in a child.
void check_alone(const PluginHost::Found& plugin, PluginHost& host, Registry& registry, Record& record) {
  record.begin("registration");
  record.add(check_plugin(plugin, host, registry));
}

/// Everything on one scene, in a child.
void check_one_scene(const Options& options, const PluginHost::Found& plugin, PluginHost& host,
                     Registry& registry, Record& record) {
  const std::string& file = options.scenes.front();
  const fs::path folder = options.work;
  record.begin("loads");
  try {
    const Scene scene = load_scene(file, conformance_overrides(plugin.info), host, registry);
    for_each_typed(scene, registry, [&](const Registry::Entry& entry, const Parameters& parameters) {
      record.use(entry.kind + ":" + entry.name);
      if (entry.plugin != plugin.name || entry.kind != "hyperelastic") return;
      record.begin("laws of " + entry.name);
      const auto material = registry.create<Potential>(entry.kind, parameters);
      for (ConformanceCheck check : check_hyperelastic(*material)) {
        check.name = entry.name + ": " + check.name;
        record.add({std::move(check)});
      }
    });
    record.add(check_scene(scene, registry, folder, [&](const std::string& what) { record.begin(what); }));
    if (!options.compare) return;
    record.begin("the same on all ranks");
    std::vector<fs::path> series;
    for (const int n : options.ranks) series.push_back(series_on_ranks(folder, n));
    record.add({check_ranks(scene, series, options.ranks)});
  } catch (...) {
    record.add({conformance_check("loads", false, text_of_exception())});
  }
}

int run_as_child(const Options& options) {
  PluginHost host({});
  const PluginHost::Found plugin = find_plugin(options.file, host);
  Registry registry = builtin_types();
  Record record(options.child);
  if (options.scenes.empty()) {
    check_alone(plugin, host, registry, record);
    return ok;
  }
  return run_on_all_ranks([&](bool) {
    check_one_scene(options, plugin, host, registry, record);
    return ok;
  });
}

/// Starts a child, and says if it did not come to its end.
Findings ask_child(const Options& options, const std::vector<std::string>& arguments,
                   const fs::path& folder) {
  fs::create_directories(folder);
  const fs::path file = folder / "findings", log = folder / "log";
  std::vector<std::string> call{own_executable().string(),
                                "plugin",
                                "test",
                                options.file,
                                "--child",
                                file.string(),
                                "--work",
                                folder.string()};
  call.insert(call.end(), arguments.begin(), arguments.end());
  const int code = run_program(call, log);
  Findings findings = read_findings(file);
  if (code == ok) return findings;
  const std::string how = code > 128 ? fmt::format("signal {} ({})", code - 128, strsignal(code - 128))
                                     : fmt::format("exit code {}", code);
  findings.checks.push_back(
      conformance_check("comes to its end", false,
                        fmt::format("ends with {} in: {}\n{}", how, findings.last, first_lines(log))));
  return findings;
}

int run(const Options& options) {
  if (!options.child.empty()) return run_as_child(options);
  PluginHost host({});
  const PluginHost::Found plugin = find_plugin(options.file, host);
  show_plugin_to_children(plugin.file.parent_path());
  const TemporaryFolder folder;
  Report report;
  const Findings alone = ask_child(options, {}, folder.path() / "alone");
  report.add(fmt::format("plugin {} {}, {}", plugin.name, plugin.info.version, plugin.file.string()),
             alone.checks);
  const bool registers = std::ranges::any_of(alone.checks, [](const ConformanceCheck& check) {
    return check.name == "registration" && check.outcome == ConformanceCheck::Outcome::passed;
  });
  if (!registers) return report.finish();

  const std::vector<std::string> scenes = options.scenes.empty() ? scenes_beside(plugin) : options.scenes;
  std::set<std::string> used;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const fs::path own = folder.path() / std::to_string(k);
    const auto incomparable = run_ranks(plugin, scenes[k], options, own);
    std::vector<std::string> arguments{"--scene", scenes[k], "--ranks",
                                       fmt::format("{}", fmt::join(options.ranks, ","))};
    if (!incomparable) arguments.emplace_back("--compare");
    Findings findings = ask_child(options, arguments, own);
    if (incomparable) findings.checks.push_back(*incomparable);
    report.add("scene " + scenes[k], findings.checks);
    used.insert(findings.used.begin(), findings.used.end());
  }
  report.add("coverage", check_coverage(plugin.info, used));
  return report.finish();
}

}  // namespace

Command plugin_test_command(CommandLine& parent) {
  CommandLine group = parent.add_subcommand("plugin", "Work on one plugin");
  group.require_subcommand();
  CommandLine line = group.add_subcommand("test",
                                          "Check what every plugin must hold: descriptor, schemas, tangents "
                                          "against finite differences, rewind of a failed "
                                          "step, restart, independence of the number of ranks");
  auto options = std::make_shared<Options>();
  line.add_option("file", options->file, "the plugin, libseam_<name>.so").required();
  line.add_option("--scene", options->scenes,
                  "scene that uses it; may be repeated; default those in conformance/<name> beside the file");
  line.add_option("--ranks", options->ranks, "numbers of ranks to compare; default 1,2,3").delimiter(',');
  // What the command says to those it starts.
  line.add_option("--child", options->child).hidden();
  line.add_option("--work", options->work).hidden();
  line.add_flag("--compare", options->compare).hidden();
  return {line, [options] { return run(*options); }};
}

}  // namespace seam::cli
