// SPDX-License-Identifier: BSD-3-Clause
// What several commands share.
#include "common.hpp"

#include <fmt/format.h>

#include "command.hpp"
#include "run.hpp"
#include "seam/base/memory.hpp"
#include "seam/base/plugin_fault.hpp"
#include "seam/contact/contact_interface.hpp"
#include "seam/cut/cut_interface.hpp"
#include "seam/interface/matching.hpp"
#include "seam/linear/linear_solver.hpp"
#include "seam/surface/body.hpp"

namespace seam::cli {

std::string as_error(const std::string& message) {
  const bool says = message.starts_with("error: ") || message.find(": error: ") != std::string::npos;
  return says ? message : "error: " + message;
}

Failure current_failure() {
  try {
    throw;
  } catch (const PluginError& e) {
    return {plugin_failure, e.what()};
  } catch (const RunFailure& e) {
    return {e.code(), e.what()};
  } catch (const PluginFault& e) {
    return {plugin_failure, e.what()};
  } catch (const OutOfMemory& e) {
    return {failed, e.what()};
  } catch (const FileError& e) {
    return {failed, e.what()};
  } catch (const Error& e) {
    return {broken_input, e.what()};
  } catch (const std::bad_alloc&) {
    return {failed, "error: " + describe_lack_of_memory("what was being done")};
  } catch (const std::exception& e) {
    return {failed, fmt::format("error: {}", e.what())};
  }
}

Registry builtin_types() {
  Registry registry;
  register_linear_solvers(registry);
  register_matching(registry);
  register_cut(registry);
  register_contact(registry);
  register_bodies(registry);
  register_constraints(registry);
  return registry;
}

Overrides parse_overrides(const std::vector<std::string>& values) {
  Overrides result;
  for (const std::string& value : values) {
    const std::size_t equals = value.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Error(
          fmt::format("error: --set {}: expected key.key=value, as in --set parameters.h=1/32", value));
    }
    result.emplace_back(value.substr(0, equals), value.substr(equals + 1));
  }
  return result;
}

void load_plugins(const std::vector<std::string>& names, bool all, PluginHost& host, Registry& registry) {
  if (!all) return host.load(names, registry);
  for (const PluginHost::Found& found : host.scan()) {
    if (!found.why_not().empty()) continue;
    std::vector<std::string> together = found.info.required_plugins;
    together.push_back(found.name);
    try {
      host.load(together, registry);
    } catch (const PluginError&) {
      // Browsing shows what works; `seam plugins` says what does not, and why.
      continue;
    }
  }
}

}  // namespace seam::cli
