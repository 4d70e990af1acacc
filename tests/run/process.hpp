// SPDX-License-Identifier: BSD-3-Clause
// A command that runs beside the test, to be sent signals.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include "cli/run_command.hpp"

namespace seam_cli_test {

class Process {
 public:
  /// @param arguments, before as of seam() @param log file that gets what the process prints
  Process(const std::string& arguments, const std::string& before, std::string log) : log_(std::move(log)) {
    const std::string command = "exec " + without_own_mpi + "SEAM_PLUGIN_PATH=" SEAM_TEST_PLUGINS " " +
                                before + " " SEAM_COMMAND " " + arguments + " >" + log_ + " 2>&1";
    id_ = fork();
    REQUIRE(id_ >= 0);
    if (id_ != 0) return;
    // Whatever this process ignores, the command is to be told of it.
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGHUP}) std::signal(signal, SIG_DFL);
    execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  ~Process() {
    if (!ended_) {
      ::kill(id_, SIGKILL);
      wait();
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  [[nodiscard]] pid_t id() const { return id_; }
  void send(int signal) const { REQUIRE(::kill(id_, signal) == 0); }
  /// The exit code; minus the signal that ended it.
  int wait() {
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    ended_ = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  /// Until something is so, however long that takes here; fails when the process ends before.
  void wait_for(const std::function<bool()>& condition) const {
    while (!condition()) {
      siginfo_t end{};
      REQUIRE(waitid(P_PID, static_cast<id_t>(id_), &end, WEXITED | WNOHANG | WNOWAIT) == 0);
      INFO(output());
      REQUIRE((end.si_pid == 0 || condition()));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  [[nodiscard]] std::string output() const {
    std::ifstream in(log_);
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  pid_t id_ = -1;
  bool ended_ = false;
  std::string log_;
};

inline void pause(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

/// A block that is pulled by a load from the plugin `trouble`, in steps of 0.1 up to t = 1.
inline std::string pulled_by(const std::string& function, const std::string& name) {
  return "title: Pulled\ndimension: 2\nplugins: [solid, trouble]\nplugin_folders: [\"" SEAM_TROUBLE_PLUGIN
         "\"]\nfunctions: {" +
         name + ": " + function +
         "}\nmeshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [2, 2]}}}\n"
         "fields:\n  block:\n    type: solid\n    mesh: block\n    density: 1\n"
         "    material: {type: neo_hookean, young: 10, poisson: 0.3}\n"
         "    boundary: [{on: x_min, displacement: [0, 0]}, {on: x_max, traction: [\"" +
         name +
         ".load\", 0]}]\ntime: {end: 1, step: {initial: 0.1}}\n"
         "output: {probes: {tip: {field: block, at: [1, 0.5], quantity: displacement}}}\n"
         "checks: [{that: tip.x, at_least: 0, source: it is pulled}]\n";
}

}  // namespace seam_cli_test
