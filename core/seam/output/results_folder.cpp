// SPDX-License-Identifier: BSD-3-Clause
#include "seam/output/results_folder.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "seam/base/all_or_none.hpp"
#include "seam/scene/scene_values.hpp"

namespace seam {
namespace {

namespace fs = std::filesystem;

constexpr const char* record_name = "run.json";
constexpr const char* manifest_name = "manifest.txt";
constexpr const char* lock_name = "run.lock";

std::string host_name() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

std::string now() {
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::chrono::system_clock::now()));
}

/// 128 random bits.
std::string new_run() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

std::string read_text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// An object, or null when there is no such file or it is damaged.
nlohmann::json read_object(const fs::path& file) {
  auto object = nlohmann::json::parse(read_text_of(file), nullptr, false);
  return object.is_object() ? object : nlohmann::json();
}

std::string word(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "unknown";
}

/// The process that a lock names, 0 when it names none.
long process_of(const nlohmann::json& holder) {
  const auto found = holder.find("process");
  return found != holder.end() && found->is_number_integer() ? found->get<long>() : 0;
}

std::string place_of(const Scene& scene) {
  std::error_code ignored;
  return fs::weakly_canonical(fs::absolute(scene.path, ignored), ignored).string();
}

/// Whether run.json holds what a run goes on from: texts as values, and lists of what was resumed and
/// changed.
bool is_whole(const nlohmann::json& record) {
  const auto is_list = [&](const char* key) { return !record.contains(key) || record.at(key).is_array(); };
  const nlohmann::json values = record.value("values", nlohmann::json::object());
  return record.contains("run") && record.at("run").is_string() && is_list("resumed") && is_list("changes") &&
         values.is_object() &&
         std::ranges::all_of(values, [](const auto& value) { return value.is_string(); });
}

/// The same file, or one of the same name and title elsewhere: folders and sources are moved together.
bool is_of_scene(const nlohmann::json& record, const Scene& scene) {
  const std::string place = word(record, "scene");
  return place == place_of(scene) || (fs::path(place).filename() == scene.path.filename() &&
                                      word(record, "title") == scene.root.text("title"));
}

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(file, ignored));
}

bool is_real_folder(const fs::path& file) {
  std::error_code ignored;
  return fs::is_directory(fs::symlink_status(file, ignored));
}

/// What a run of any scene may leave, as far as its name tells.
bool looks_like_results(const fs::path& entry) {
  const std::string name = entry.filename().string();
  constexpr std::array<std::string_view, 8> names{"series.csv",  "events.jsonl", "summary.json",
                                                  "picture.png", "restart",      "fields",
                                                  "interfaces",  manifest_name};
  return entry.extension() == ".pvd" || std::ranges::find(names, name) != names.end();
}

std::string step_text(long step) {
  if (step == ResultsFolder::all_steps) return "all";
  return step == ResultsFolder::at_the_end ? "end" : std::to_string(step);
}

std::optional<long> step_of(const std::string& text) {
  if (text == "all") return ResultsFolder::all_steps;
  if (text == "end") return ResultsFolder::at_the_end;
  if (text.empty() || text.size() > 15 || text.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  return std::stol(text);
}

std::string manifest_line(const std::string& name, long step) {
  return fmt::format("{} {}\n", step_text(step), name);
}

/// False for what leads out of the folder: no run writes such a line, but somebody may.
bool stays_within(const fs::path& name) {
  return !name.empty() && name.is_relative() &&
         std::none_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".."; });
}

}  // namespace

/// A file that a living process holds: the system gives it up when the process ends, in whatever way.
class ResultsFolder::Lock {
 public:
  Lock(const fs::path& file, const std::string& folder, const nlohmann::json& holder) : file_(file) {
    while (!try_take(folder)) {
    }
    const std::string text = holder.dump() + "\n";
    if (::ftruncate(handle_, 0) != 0 || ::pwrite(handle_, text.data(), text.size(), 0) < 0) {
      const int error = errno;
      ::close(handle_);
      throw FileError(Location{file_.string()}, "cannot write the lock: " + describe_system_error(error));
    }
  }
  ~Lock() {
    ::unlink(file_.c_str());
    ::close(handle_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  /// @returns false when the file was another one's that has just gone: once more
  bool try_take(const std::string& folder) {
    handle_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (handle_ < 0)
      throw FileError(Location{folder},
                      "the results cannot be written here: " + describe_system_error(errno));
    if (::flock(handle_, LOCK_EX | LOCK_NB) != 0) {
      const bool is_held = errno == EWOULDBLOCK || is_held_by_content();
      if (is_held) {
        const nlohmann::json holder = read_object(file_);
        ::close(handle_);
        throw Error(
            Location{folder},
            fmt::format("another run is at work in this folder (process {} on {}, of '{}', since {}). "
                        "Wait for it, or choose another --folder; if that process does not exist any "
                        "more, delete '{}'",
                        process_of(holder), word(holder, "host"), word(holder, "scene"),
                        word(holder, "started"), file_.string()));
      }
    }
    struct stat mine {
    }, there{};
    if (::fstat(handle_, &mine) == 0 && ::stat(file_.c_str(), &there) == 0 && mine.st_ino == there.st_ino)
      return true;
    ::close(handle_);
    return false;
  }

  /// On file systems without locks: what the file says about who holds it.
  [[nodiscard]] bool is_held_by_content() const {
    const nlohmann::json holder = read_object(file_);
    if (holder.is_null()) return false;
    if (word(holder, "host") != host_name()) return true;
    return ::kill(static_cast<pid_t>(process_of(holder)), 0) == 0 || errno == EPERM;
  }

  fs::path file_;
  int handle_ = -1;
};

/// run.json.
struct ResultsFolder::Record {
  nlohmann::json data = nlohmann::json::object();
};

ResultsFolder::ResultsFolder(const Communicator& communicator, const Scene& scene, fs::path folder,
                             const FolderUse& use)
    : communicator_(communicator),
      scene_(scene),
      path_(std::move(folder)),
      record_(std::make_unique<Record>()),
      overwrite_(use.overwrite) {
  all_or_none(communicator_, [&] {
    if (communicator_.rank() == 0) take(use);
  });
  run_ = from_root(communicator_, run_);
}

ResultsFolder::~ResultsFolder() = default;

void ResultsFolder::take(const FolderUse& use) {
  std::error_code code;
  fs::create_directories(path_, code);
  if (code || !fs::is_directory(path_))
    throw FileError(Location{path_.string()}, "there is no folder for the results: " +
                                                  describe_system_error(code ? code.value() : ENOTDIR));
  lock_ = std::make_unique<Lock>(path_ / lock_name, path_.string(),
                                 nlohmann::json{{"host", host_name()},
                                                {"process", static_cast<long>(::getpid())},
                                                {"scene", place_of(scene_)},
                                                {"title", scene_.root.text("title")},
                                                {"started", now()}});
  judge(use);
  if (!resumed_) run_ = new_run();
}

void ResultsFolder::judge(const FolderUse& use) {
  if (!is_there(path_ / record_name)) {
    if (!overwrite_) judge_unlisted();
    return;
  }
  const nlohmann::json found = read_object(path_ / record_name);
  read_manifest();
  if (overwrite_) return;
  const auto refuse = [&](const std::string& message) { throw Error(Location{path_.string()}, message); };
  if (found.is_null() || !is_whole(found))
    refuse(
        fmt::format("'{}' is damaged, so that nobody knows which run wrote this folder; choose another "
                    "--folder, or replace what is here with --overwrite",
                    record_name));
  if (!is_of_scene(found, scene_))
    refuse(
        fmt::format("this folder holds results of another scene, '{}' ({}); choose another --folder, or "
                    "replace them with --overwrite",
                    word(found, "title"), word(found, "scene")));
  record_->data = found;
  // Without it nobody knows which restart points are this run's, and which files it may replace.
  if (use.resume && files_.empty() && is_there(path_ / "series.csv"))
    refuse(
        fmt::format("'{}', the list of what this run wrote, is missing or damaged, so that the run cannot go "
                    "on; choose another --folder, or replace what is here with --overwrite",
                    manifest_name));
  if (use.resume) {
    judge_changes(use);
    run_ = word(found, "run");
    resumed_ = true;
    return;
  }
  const std::string status = word(found, "status");
  if (status == "finished" || status == "failed") return;
  refuse(
      fmt::format("this folder holds a run that did not reach its end ({}). Go on with it by --resume, "
                  "replace it by --overwrite, or choose another --folder",
                  status == "running" ? "its process was killed" : status));
}

void ResultsFolder::judge_changes(const FolderUse& use) {
  const auto before = record_->data.value("values", std::map<std::string, std::string>());
  const auto differences = scene_differences(before, scene_values(scene_));
  if (differences.empty()) return;
  if (!use.changed)
    throw Error(
        Location{path_.string()},
        fmt::format("the scene is not what it was when this run began:\n  {}\nGive the same values as "
                    "then, or go on with the changed scene by --resume --changed",
                    fmt::join(differences, "\n  ")));
  record_->data["changes"].push_back(differences);
}

void ResultsFolder::judge_unlisted() const {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(path_))
    if (looks_like_results(entry.path())) found.push_back(entry.path().filename().string());
  if (found.empty()) return;
  std::sort(found.begin(), found.end());
  throw Error(
      Location{path_.string()},
      fmt::format("this folder holds results ({}) but no '{}' that says which run wrote them: they are "
                  "neither resumed nor replaced. Choose another --folder, or go ahead with --overwrite",
                  fmt::join(found, ", "), record_name));
}

std::vector<std::string> ResultsFolder::restart_points() const {
  std::vector<std::string> result;
  for (const auto& [name, step] : files_)
    if (name.starts_with("restart/") && name.ends_with(".restart") && is_there(path_ / name))
      result.push_back(name);
  std::sort(result.rbegin(), result.rend());
  return result;
}

bool ResultsFolder::is_name_of_file(const fs::path& name) {
  static const std::set<std::string> endings{".csv",  ".json", ".jsonl", ".lock",    ".png", ".pvd",
                                             ".pvtu", ".txt",  ".vtu",   ".restart", ".vtp", ".pvtp"};
  return endings.contains(name.extension().string());
}

bool ResultsFolder::has_finished() const {
  const bool mine = communicator_.rank() == 0 && resumed_ && word(record_->data, "status") == "finished" &&
                    restart_points().empty();
  return communicator_.any(mine);
}

void ResultsFolder::begin(std::optional<long> resumed_at) {
  all_or_none<FileError>(communicator_, [&] {
    if (communicator_.rank() == 0) clear(resumed_at);
  });
  begun_ = true;
}

void ResultsFolder::clear(std::optional<long> resumed_at) {
  for (auto entry = files_.begin(); entry != files_.end();) {
    // What is not there was removed when the process was killed, before that could be noted.
    if (resumed_at && entry->second <= *resumed_at && is_there(path_ / entry->first)) {
      ++entry;
      continue;
    }
    remove_listed(entry->first);
    entry = files_.erase(entry);
  }
  std::error_code ignored;
  for (const char* folder : {"fields", "restart", "interfaces"})
    if (is_real_folder(path_ / folder)) fs::remove(path_ / folder, ignored);  // only when it is empty
  nlohmann::json& data = record_->data;
  if (!resumed_at) {
    const auto changes = data.value("changes", nlohmann::json::array());
    data = {{"run", run_}, {"started", now()}, {"changes", changes}};
    if (!resumed_) data["changes"] = nlohmann::json::array();
  } else {
    data["resumed"].push_back({{"step", *resumed_at}, {"at", now()}});
  }
  data["title"] = scene_.root.text("title");
  data["scene"] = place_of(scene_);
  data["values"] = scene_values(scene_);
  data["ranks"] = communicator_.size();
  data["host"] = host_name();
  data["process"] = static_cast<long>(::getpid());
  write_record("running");
  rewrite_manifest();
}

void ResultsFolder::write_record(const std::string& status) {
  record_->data["status"] = status;
  // What is no UTF-8 (a folder's name may be anything) must not end the run.
  write_whole_file((path_ / record_name).string(),
                   record_->data.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n",
                   Durability::on_disk);
}

void ResultsFolder::read_manifest() {
  std::istringstream in(read_text_of(path_ / manifest_name));
  for (std::string line; std::getline(in, line);) {
    // A line that its writer did not complete names a file that was never begun.
    if (in.eof()) break;
    const std::size_t space = line.find(' ');
    if (line.starts_with('#') || space == std::string::npos) continue;
    const std::string first = line.substr(0, space), name = line.substr(space + 1);
    if (first == "removed")
      files_.erase(name);
    else if (const std::optional<long> step = step_of(first); step && stays_within(name))
      files_[name] = *step;
  }
}

void ResultsFolder::rewrite_manifest() {
  std::string text =
      "# What this run wrote: the step it belongs to, and the file. A later run removes these, and no "
      "others.\n";
  for (const auto& [name, step] : files_) text += manifest_line(name, step);
  const std::string file = (path_ / manifest_name).string();
  write_whole_file(file, text);
  manifest_ = GrowingFile(file);
}

void ResultsFolder::remove_listed(const std::string& name) const {
  fs::path folder = path_;
  for (const fs::path& part : fs::path(name).parent_path()) {
    folder /= part;
    // What lies behind a link is not this folder's.
    if (!is_real_folder(folder)) return;
  }
  // What a process that was killed did not put in place.
  ::unlink((path_ / (name + ".tmp")).c_str());
  if (::unlink((path_ / name).c_str()) != 0 && errno != ENOENT && errno != EISDIR)
    throw FileError(Location{(path_ / name).string()},
                    "cannot remove what the last run wrote: " + describe_system_error(errno));
}

void ResultsFolder::make_subfolder(const std::string& name) const {
  if (communicator_.rank() != 0) return;
  const fs::path folder = path_ / name;
  if (::mkdir(folder.c_str(), 0777) == 0) return;
  const int error = errno;
  if (error == EEXIST && is_real_folder(folder)) return;
  throw FileError(Location{folder.string()},
                  error == EEXIST
                      ? "expected a folder for results, found a file or a symbolic link, which is "
                        "not followed; move it away, or choose another --folder"
                      : "cannot make the folder: " + describe_system_error(error));
}

void ResultsFolder::claim(const std::string& name, long step) {
  if (communicator_.rank() != 0) return;
  const fs::path parent = fs::path(name).parent_path();
  if (!parent.empty()) make_subfolder(parent.string());
  if (files_.contains(name)) return;
  if (!overwrite_ && is_there(path_ / name))
    throw FileError(Location{(path_ / name).string()},
                    "this file is there already, and no run of this scene wrote it; move it away, choose "
                    "another --folder, or replace it with --overwrite");
  manifest_.append(manifest_line(name, step));
  files_[name] = step;
}

void ResultsFolder::remove(const std::string& name) {
  if (communicator_.rank() != 0 || !files_.contains(name)) return;
  remove_listed(name);
  files_.erase(name);
  manifest_.append(fmt::format("removed {}\n", name));
}

void ResultsFolder::finish(const std::string& status) {
  all_or_none<FileError>(communicator_, [&] {
    if (communicator_.rank() != 0) return;
    record_->data["ended"] = now();
    rewrite_manifest();
    write_record(status);
  });
}

bool ResultsFolder::belongs_to_another(const fs::path& folder, const Scene& scene) {
  for (const char* name : {record_name, lock_name})
    if (const nlohmann::json record = read_object(folder / name); !record.is_null())
      return !is_of_scene(record, scene);
  return false;
}

}  // namespace seam
