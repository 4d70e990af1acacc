// SPDX-License-Identifier: BSD-3-Clause
#include "seam/base/plugin_fault.hpp"

#include <cxxabi.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <memory>

namespace seam {

std::string of_plugin(const void* address) {
  Dl_info info{};
  if (dladdr(address, &info) == 0 || !info.dli_fname) return "";
  const std::string file = std::filesystem::path(info.dli_fname).filename().string();
  const std::string start = "libseam_", end = ".so";
  // The core has a version at its end.
  if (!file.starts_with(start) || !file.ends_with(end)) return "";
  return fmt::format(" of plugin '{}'", file.substr(start.size(), file.size() - start.size() - end.size()));
}

std::string text_of_exception() {
  try {
    throw;
  } catch (const Error& error) {
    return error.what();
  } catch (const std::exception& error) {
    const std::unique_ptr<char, decltype(&std::free)> name(
        abi::__cxa_demangle(typeid(error).name(), nullptr, nullptr, nullptr), &std::free);
    return fmt::format("{} ({})", error.what(), name ? name.get() : typeid(error).name());
  } catch (...) {
    const std::type_info* type = abi::__cxa_current_exception_type();
    const std::unique_ptr<char, decltype(&std::free)> name(
        type ? abi::__cxa_demangle(type->name(), nullptr, nullptr, nullptr) : nullptr, &std::free);
    return fmt::format("an exception of type {}, which says nothing", name ? name.get() : "unknown");
  }
}

}  // namespace seam
