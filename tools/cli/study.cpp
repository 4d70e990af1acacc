// SPDX-License-Identifier: BSD-3-Clause
// seam study: run a scene over ranges of values; compare error with cell size, unknowns, seconds and memory.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "circumstances.hpp"
#include "command.hpp"
#include "json_file.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/base/program.hpp"
#include "seam/output/atomic_file.hpp"
#include "study_report.hpp"

namespace seam::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string scene;
  std::vector<std::string> set;
  fs::path folder;
  std::string record;
  bool overwrite = false;
};

/// What reproduces the study, with the scene relative to the current folder.
std::string command_line(const Options& options) {
  const fs::path scene = fs::proximate(options.scene);
  std::string text = "seam study " + (scene.native().starts_with("..") ? scene.filename() : scene).string();
  for (const std::string& value : options.set) text += fmt::format(" --set '{}'", value);
  return text + (options.record.empty() ? "" : " --record " + options.record);
}

/// The last line of a file that is not blank.
std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  return last;
}

/// What a case's run left: its summary, or nothing when it broke off early.
nlohmann::json read_summary(const fs::path& folder) { return read_json(folder / "summary.json"); }

/// The mark of the run that wrote a folder, "" when there is none.
std::string run_of(const fs::path& folder) {
  const nlohmann::json record = read_json(folder / "run.json");
  const auto found = record.is_object() ? record.find("run") : record.end();
  return found != record.end() && found->is_string() ? found->get<std::string>() : "";
}

/// Runs a case in a process of its own, so that its seconds and its peak memory are its own.
StudyRecord run_case(const StudyPlan& plan, const StudyCase& one, const Options& options,
                     const fs::path& folder, nlohmann::json& versions) {
  StudyRecord record;
  record.of = one;
  fs::create_directories(folder);
  const std::string before = run_of(folder);
  std::vector<std::string> call{own_executable().string(),
                                "run",
                                options.scene,
                                "--quiet",
                                "--no-picture",
                                "--folder",
                                folder.string()};
  std::vector<std::string> set{"output.fields=false"};
  set.insert(set.end(), options.set.begin(), options.set.end());
  const std::vector<std::string> own = overrides_of(plan, one);
  set.insert(set.end(), own.begin(), own.end());
  for (const std::string& value : set) call.insert(call.end(), {"--set", value});

  if (options.overwrite) call.emplace_back("--overwrite");
  const std::vector<std::string> trust = trust_as_words();
  call.insert(call.end(), trust.begin(), trust.end());

  const fs::path log = folder / "log.txt";
  const int code = run_program(call, log);
  record.code = code;
  // A run that did not even begin has left the files of the one before as they were.
  record.has_begun = run_of(folder) != before;
  const nlohmann::json summary = record.has_begun ? read_summary(folder) : nlohmann::json();
  const std::string status = summary.is_object() ? summary.value("status", "") : "";
  record.is_interrupted = status == "interrupted";
  // A check that fails makes exit code 1, too: on coarse meshes that is what a study is there to show.
  const bool is_finished = status == "finished";
  if (!is_finished) {
    record.problem = summary.is_object() ? summary.value("reason", last_line(log)) : last_line(log);
    if (record.problem.empty())
      record.problem = fmt::format("exit code {}, see {}/log.txt", code, folder.filename().string());
    return record;
  }
  versions = summary.at("versions");
  return record;
}

void read_measures(StudyRecord& record, const StudyReport& report, const fs::path& folder) {
  if (!record.problem.empty() && !report.plan.until_failure) return;
  if (!record.has_begun) return;
  const nlohmann::json summary = read_summary(folder);
  for (const std::string& column : report.columns()) {
    try {
      if (summary.is_object()) record.numbers[column] = measure(summary, column);
    } catch (const Error&) {
      if (record.problem.empty()) throw;  // what is known at the end only, a failed run does not have
    }
  }
}

void show(const StudyReport& report, const StudyRecord& record) {
  std::string line = fmt::format("[{}/{}]", report.records.size() + 1, report.plan.cases.size());
  for (std::size_t k = 0; k < report.plan.labels.size(); ++k)
    line += fmt::format(" {}={}", report.plan.labels[k], record.of.values[k]);
  for (const std::string& name : report.plan.measures)
    if (const auto found = record.numbers.find(name); found != record.numbers.end())
      line += fmt::format("  {} {:.6g}", name, found->second);
  if (record.problem.empty())
    fmt::print("{}  ({:.2f} s)\n", line, record.numbers.at("seconds.total"));
  else
    fmt::print("{}: {}\n", line, record.problem);
  std::fflush(stdout);
}

/// Draws the table; false, with a message, when that fails: the numbers are there all the same.
bool draw(const StudyReport& report, const fs::path& folder) {
  const fs::path script = own_executable().parent_path().parent_path() / "share/seam/plot_study.py";
  // The plain python3 of a machine need not be the one that has Debian's packages.
  const std::string python = fs::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
  std::vector<std::string> call{python,
                                script.string(),
                                (folder / "study.csv").string(),
                                (folder / "study.png").string(),
                                "--against",
                                report.plan.labels[report.plan.against]};
  for (const std::string& label : report.plan.labels) call.insert(call.end(), {"--key", label});
  for (const std::string& name : report.plan.measures) call.insert(call.end(), {"--measure", name});
  const fs::path log = folder / "plot.log";
  if (run_program(call, log) == 0) {
    fs::remove(log);
    return true;
  }
  fmt::print(stderr, "warning: no picture was made ({}); see {}\n", last_line(log), log.string());
  return false;
}

/// @throws Error when the tables that a study writes are there, and no study wrote them
void refuse_foreign_tables(const fs::path& folder) {
  const fs::path table = folder / "study.csv";
  bool is_own = !fs::exists(fs::symlink_status(folder / "study.md"));
  if (fs::exists(fs::symlink_status(table))) {
    std::ifstream in(table);
    is_own = false;
    for (std::string line; !is_own && std::getline(in, line) && line.starts_with('#');)
      is_own = line.starts_with("# command: seam study");
  }
  if (!is_own)
    throw Error(
        fmt::format("'{}' holds tables (study.csv, study.md) that `seam study` did not write; choose another "
                    "--folder, or replace them with --overwrite",
                    folder.string()));
}

void write(const StudyReport& report, const fs::path& folder) {
  write_text_atomically((folder / "study.csv").string(), csv(report));
  const bool has_picture = draw(report, folder);
  write_text_atomically((folder / "study.md").string(), markdown(report, has_picture ? "study.png" : ""));
}

/// Copies what is worth keeping to the documentation of the source tree one stands in.
void keep(const fs::path& folder, const std::string& name) {
  if (!fs::is_directory("docs"))
    throw Error("--record: there is no folder docs here; call it in the top folder of the source tree");
  const fs::path to = fs::path("docs/results") / name;
  fs::create_directories(to);
  for (const std::string file : {"study.csv", "study.md", "study.png"})
    if (fs::exists(folder / file))
      fs::copy_file(folder / file, to / file, fs::copy_options::overwrite_existing);
  fmt::print("  recorded: {}\n", to.string());
}

int run(const Options& options) {
  StudyReport report;
  report.plan = plan_study(options.scene, options.set);
  const fs::path folder = options.folder.empty()
                              ? fs::path("results") / (fs::path(options.scene).stem().string() + "-study")
                              : options.folder;
  if (!options.overwrite) refuse_foreign_tables(folder);
  nlohmann::json versions;
  int bad = 0;
  for (std::size_t i = 0; i < report.plan.cases.size(); ++i) {
    const fs::path own = folder / fmt::format("case{:03}", i + 1);
    StudyRecord record = run_case(report.plan, report.plan.cases[i], options, own, versions);
    read_measures(record, report, own);
    show(report, record);
    if (record.is_interrupted) {
      fmt::print(stderr, "the study is interrupted; its cases so far are in {}\n", folder.string());
      return record.code;
    }
    bad += record.problem.empty() || report.plan.until_failure ? 0 : 1;
    report.records.push_back(std::move(record));
  }
  const std::string fingerprint = versions.is_object() ? versions.value("fingerprint", "unknown") : "unknown";
  report.title = fmt::format("{}: {}", fs::path(options.scene).filename().string(), report.plan.title);
  report.circumstances = circumstances(options.scene, fingerprint);
  report.circumstances.insert(
      report.circumstances.end(),
      {{"each run", "one process on one core, field output off; seconds include meshing and set-up"},
       {"command", command_line(options)}});
  write(report, folder);
  fmt::print("  table:   {}\n  picture: {}\n", (folder / "study.md").string(),
             (folder / "study.png").string());
  if (!options.record.empty()) keep(folder, options.record);
  return bad == 0 ? ok : failed;
}

}  // namespace

Command study_command(CommandLine& parent) {
  CommandLine line =
      parent.add_subcommand("study", "Run a scene over the ranges of its study block and compare the runs");
  auto options = std::make_shared<Options>();
  line.add_option("scene", options->scene, "YAML file with a study block").required();
  line.add_option("--set", options->set, "replace a value in all runs: key.key=value; may be repeated")
      .take_all();
  line.add_option("--folder", options->folder, "where results go; default results/<scene>-study");
  line.add_flag("--overwrite", options->overwrite,
                "replace what is in the folders of the cases, whatever wrote it");
  line.add_option("--record", options->record, "copy table and picture to docs/results/<name>, too");
  return {line, [options] { return run(*options); }};
}

}  // namespace seam::cli
