// SPDX-License-Identifier: BSD-3-Clause
#include "matrix_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <map>

#include "../json_file.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/output/atomic_file.hpp"

namespace seam::cli {
namespace {

namespace fs = std::filesystem;

const std::string table_name = "matrix.json", lock_name = ".matrix.lock";

fs::path anywhere(const fs::path& file) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(fs::absolute(file, error), error);
  return error ? file : whole;
}

void make_folders(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error({folder.string()}, "the folder cannot be made: " + error.message());
}

/// The rows of a table; none where there is no such table.
nlohmann::json rows_of(const fs::path& file) {
  const nlohmann::json table = read_json(file);
  const bool is_table = table.is_object() && table.contains("variants") && table.at("variants").is_array();
  nlohmann::json rows = nlohmann::json::array();
  if (is_table)
    for (const nlohmann::json& row : table.at("variants"))
      if (row.is_object() && row.contains("file") && row.contains("variant") && row.contains("verdict"))
        rows.push_back(row);
  return rows;
}

VariantName name_of(const nlohmann::json& row) { return {row.value("file", ""), row.value("variant", "")}; }

}  // namespace

VariantName name_of(const MatrixPlan& plan, const Variant& variant) {
  return {anywhere(plan.scene), variant.name};
}

MatrixFolder::MatrixFolder(fs::path path) : path_(std::move(path)) {
  std::error_code error;
  const bool is_other = fs::exists(path_, error) &&
                        !(fs::is_directory(path_, error) && fs::is_empty(path_, error)) &&
                        !fs::exists(path_ / table_name, error) && !fs::exists(path_ / lock_name, error);
  if (is_other)
    throw Error({path_.string()},
                fmt::format("the folder holds what `seam verify --matrix` did not write ({} is not in it); "
                            "choose another --folder",
                            table_name));
  make_folders(path_);
  lock_ = open((path_ / lock_name).c_str(), O_CREAT | O_RDWR | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (lock_ < 0) throw Error({path_.string()}, "the folder cannot be written to");
  if (flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
  close(lock_);
  throw Error({path_.string()},
              "another `seam verify --matrix` is at work in this folder; choose another --folder, or wait");
}

MatrixFolder::~MatrixFolder() { close(lock_); }

std::set<VariantName> MatrixFolder::failed_last_time(const std::vector<MatrixPlan>& plans) const {
  if (!fs::exists(path_ / table_name))
    throw Error({(path_ / table_name).string()},
                "--failed: there is no table of an earlier run; run without it first");
  std::set<fs::path> scenes;
  std::set<VariantName> known, failed;
  for (const MatrixPlan& plan : plans) {
    scenes.insert(anywhere(plan.scene));
    for (const Variant& variant : plan.variants) known.insert(name_of(plan, variant));
  }
  for (const nlohmann::json& row : rows_of(path_ / table_name)) {
    const VariantName name = name_of(row);
    if (!scenes.contains(name.first) || row.value("verdict", "") == "ok" ||
        row.value("verdict", "") == "known")
      continue;
    if (!known.contains(name))
      throw Error({name.first.string()},
                  fmt::format("--failed: '{}' failed last time, and the scene has no such variant any more; "
                              "run without --failed",
                              name.second));
    failed.insert(name);
  }
  return failed;
}

void MatrixFolder::make_new(const fs::path& folder) const {
  std::error_code error;
  for (fs::path part = folder.parent_path(); part != path_ && !part.empty(); part = part.parent_path())
    if (fs::is_symlink(fs::symlink_status(part, error)))
      throw Error({part.string()}, "a link stands where the matrix has a folder of its own; take it away");
  fs::remove_all(folder, error);
  make_folders(folder);
}

void MatrixFolder::write_table(const std::vector<VariantResult>& results,
                               const std::vector<MatrixPlan>& plans) const {
  std::set<fs::path> scenes;
  std::set<VariantName> kept, now;
  for (const MatrixPlan& plan : plans) {
    scenes.insert(anywhere(plan.scene));
    for (const Variant& variant : plan.variants) kept.insert(name_of(plan, variant));
  }
  nlohmann::json rows = as_json(results);
  for (nlohmann::json& row : rows) {
    row["file"] = anywhere(row.value("scene", "")).string();
    now.insert(name_of(row));
  }
  for (const nlohmann::json& row : rows_of(path_ / table_name)) {
    const VariantName name = name_of(row);
    if (!now.contains(name) && (kept.contains(name) || !scenes.contains(name.first))) rows.push_back(row);
  }
  std::map<std::string, int> count;
  for (const nlohmann::json& row : rows) ++count[row.at("verdict")];
  const nlohmann::json table{{"ok", count["ok"]},
                             {"known", count["known"]},
                             {"failed", count["FAIL"]},
                             {"not_run", count["not run"]},
                             {"variants", rows}};
  write_text_atomically((path_ / table_name).string(),
                        table.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void MatrixFolder::write(const std::vector<VariantResult>& results, const std::vector<MatrixPlan>& plans,
                         const std::vector<std::pair<std::string, std::string>>& circumstances) const {
  write_table(results, plans);
  write_text_atomically((path_ / "matrix.md").string(), as_markdown(results, circumstances));
  write_text_atomically((path_ / "junit.xml").string(), as_junit(results));
}

}  // namespace seam::cli
