// SPDX-License-Identifier: BSD-3-Clause
#include <Trilinos_version.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <nlohmann/json.hpp>

#include "seam/base/checksum.hpp"
#include "seam/base/memory.hpp"
#include "seam/plugin/plugin_info.hpp"
#include "seam/run/simulation.hpp"

namespace seam {
namespace {

nlohmann::json machine() {
  utsname name{};
  uname(&name);
  return {{"system", name.sysname}, {"release", name.release}, {"architecture", name.machine}};
}

/// Changes with the scene's text and with every value that replaces one of it.
std::string scene_hash(const Scene& scene) {
  std::string all = scene.text;
  for (const auto& [path, value] : scene.overrides) all += fmt::format("\n--set {}={}", path, value);
  return fmt::format("{:016x}", checksum(all));
}

nlohmann::json histories(const std::vector<NewtonReport>& reports) {
  auto all = nlohmann::json::array();
  for (const NewtonReport& report : reports) {
    auto steps = nlohmann::json::array();
    for (const NewtonIteration& i : report.history)
      steps.push_back({{"residual", i.residual},
                       {"worst", i.worst},
                       {"increment", i.increment},
                       {"damping", i.damping},
                       {"linear_iterations", i.linear_iterations},
                       {"linear_residual", i.linear_residual},
                       {"space_changed", i.space_changed}});
    all.push_back({{"converged", report.converged},
                   {"reason", report.reason},
                   {"frozen", report.frozen},
                   {"shares", report.shares},
                   {"iterations", steps}});
  }
  return all;
}

}  // namespace

nlohmann::json Simulation::summary(const std::vector<CheckResult>& checks) {
  const RunState& state = session_.state();
  nlohmann::json s;
  s["title"] = scene_.root.text("title");
  s["scene"] = scene_.path.filename().string();
  s["scene_hash"] = scene_hash(scene_);
  s["resolved_checksum"] = resolved_checksum_;
  s["overrides"] = nlohmann::json::array();
  for (const auto& [path, value] : scene_.overrides) s["overrides"].push_back(path + "=" + value);
  s["status"] = status();
  if (!failure_.empty()) s["reason"] = failure_;
  if (interruption_) s["reason"] = interruption_->reason;
  s["time"] = state.time;
  s["parameters"] = scene_.parameters;
  s["versions"] = {{"fingerprint", host_fingerprint()}, {"trilinos", TRILINOS_VERSION_STRING}};
  s["machine"] = machine();
  s["ranks"] = communicator_.size();
  s["unknowns"] = session_.unknowns();
  s["steps"] = state.step_number;
  s["rejected_steps"] = state.rejected_steps;
  s["seconds"] = {{"setup", timings_.setup},       {"cut", timings_.cut},       {"pattern", timings_.pattern},
                  {"assembly", timings_.assembly}, {"linear", timings_.linear}, {"output", timings_.output},
                  {"total", timings_.total}};
  if (const std::string choice = session_.linear_choice(); !choice.empty()) s["linear_solver"] = choice;
  s["peak_memory_bytes"] = communicator_.sum(peak_memory());
  s["newton"] = histories(session_.reports());
  s["results"] = nlohmann::json::object();
  for (const std::string& name : state.results.names()) s["results"][name] = state.results.value(name);
  s["warnings"] = nlohmann::json::array();
  for (const Diagnostic& warning : session_.warnings().all()) s["warnings"].push_back(warning.text());
  s["checks"] = nlohmann::json::array();
  for (const CheckResult& c : checks) {
    s["checks"].push_back({{"that", c.that},
                           {"kind", c.kind},
                           {"value", c.value},
                           {"expected", c.expected},
                           {"deviation", c.deviation},
                           {"passed", c.passed},
                           {"source", c.source}});
    if (c.is) s["checks"].back()["is"] = *c.is;
  }
  return s;
}

}  // namespace seam
