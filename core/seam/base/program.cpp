// SPDX-License-Identifier: BSD-3-Clause
#include "seam/base/program.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "seam/base/diagnostics.hpp"
#include "seam/base/stopwatch.hpp"

namespace seam {
namespace {

/// The exit code of a child, once it has ended.
int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return 127;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// In a child: it ends with this process, even when that is killed; which it may have been already.
void end_with(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
}

/// A new file for what a program prints; -1 when it cannot be made.
int open_output(const std::filesystem::path& output) {
  return open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0644);
}

void limit(decltype(RLIMIT_AS) resource, double value) {
  rlimit bounds{};
  if (getrlimit(resource, &bounds) != 0) return;
  // A limit that is stricter already stays.
  bounds.rlim_cur = std::min(bounds.rlim_max, static_cast<rlim_t>(std::min(value, 9e18)));
  setrlimit(resource, &bounds);
}

/// In a child: what holds it to its limits. Only async-signal-safe calls.
void confine(const ProgramLimits& limits, pid_t parent) {
  end_with(parent);
  limit(RLIMIT_AS, limits.memory_bytes);
  limit(RLIMIT_FSIZE, limits.file_bytes);
  limit(RLIMIT_CPU, std::ceil(limits.seconds) + 1);
  limit(RLIMIT_CORE, 0);
  std::signal(SIGXFSZ, SIG_DFL);
}

/// Starts a program whose streams go to the given files (-1: leave). Returns the process, or -1.
/// @param prepare called in the child: only async-signal-safe calls
template <class Prepare>
pid_t start(const std::vector<std::string>& arguments, int out, int err, Prepare&& prepare) {
  // All memory is taken before fork: afterwards only async-signal-safe calls are allowed.
  std::vector<char*> argv;
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child != 0) return child;
  prepare(parent);
  if (out >= 0) dup2(out, STDOUT_FILENO);
  if (err >= 0) dup2(err, STDERR_FILENO);
  execvp(argv[0], argv.data());
  _exit(127);
}

pid_t start(const std::vector<std::string>& arguments, int out, int err) {
  return start(arguments, out, err, [](pid_t) {});
}

}  // namespace

int run_program(const std::vector<std::string>& arguments, const std::filesystem::path& output) {
  int file = -1;
  if (!output.empty()) {
    file = open_output(output);
    if (file < 0) return 127;
  }
  const pid_t child = start(arguments, file, file);
  if (file >= 0) close(file);
  return child < 0 ? 127 : wait_for(child);
}

int run_program(const std::vector<std::string>& arguments, const NamelessFile& output,
                const ProgramLimits& limits) {
  const int file = open(output.path().c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) return 127;
  const pid_t child = start(arguments, file, file, [&](pid_t parent) { confine(limits, parent); });
  close(file);
  if (child < 0) return 127;
  siginfo_t ended{};
  constexpr useconds_t longest_pause = 20000;
  useconds_t pause = 500;
  for (const Stopwatch watch; watch.seconds() < limits.seconds;) {
    // Looks whether it has ended without taking its exit code.
    if (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 && errno != EINTR)
      return 127;
    if (ended.si_pid == child) return wait_for(child);
    usleep(pause);
    pause = std::min(2 * pause, longest_pause);
  }
  kill(child, SIGKILL);
  wait_for(child);
  return timed_out;
}

RunningProgram::RunningProgram(const std::vector<std::string>& arguments,
                               const std::filesystem::path& output) {
  constexpr int not_started = 127;
  const int file = open_output(output);
  if (file >= 0)
    process_ = start(arguments, file, file, [](pid_t parent) {
      end_with(parent);
      setpgid(0, 0);
    });
  if (file >= 0) close(file);
  if (process_ < 0)
    code_ = not_started;
  else
    setpgid(process_, process_);  // here, too: whichever comes first, the group is there before it is used
}

RunningProgram::~RunningProgram() {
  if (code_) return;
  send(SIGKILL);
  wait_for(process_);
}

std::optional<int> RunningProgram::ended() {
  siginfo_t info{};
  // Looks whether it has ended without taking its exit code.
  if (!code_ && waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
      info.si_pid == process_)
    code_ = wait_for(process_);
  return code_;
}

void RunningProgram::send(int signal) const {
  if (!code_) kill(-process_, signal);
}

NamelessFile::NamelessFile() {
  std::string name = (std::filesystem::temp_directory_path() / "seam-XXXXXX").string();
  // Programs that are started inherit it: that is what it is for.
  handle_ = mkstemp(name.data());
  if (handle_ < 0)
    throw Error("cannot make a temporary file '" + name + "': " + std::strerror(errno) +
                "; set TMPDIR to a folder that can be written to");
  unlink(name.c_str());
}

NamelessFile::~NamelessFile() { close(handle_); }

std::string NamelessFile::path() const { return "/proc/self/fd/" + std::to_string(handle_); }

std::string NamelessFile::read() const {
  std::string text;
  char buffer[1 << 16];
  for (ssize_t n = 0; (n = pread(handle_, buffer, sizeof buffer, static_cast<off_t>(text.size()))) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
  return text;
}

std::string program_output(const std::vector<std::string>& arguments) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return "";
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  const pid_t child = start(arguments, ends[1], nowhere);
  close(ends[1]);
  if (nowhere >= 0) close(nowhere);
  std::string text;
  char buffer[1024];
  for (ssize_t n = 0; (n = read(ends[0], buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
  close(ends[0]);
  if (child < 0 || wait_for(child) != 0) return "";
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::filesystem::path own_executable() { return std::filesystem::read_symlink("/proc/self/exe"); }

}  // namespace seam
