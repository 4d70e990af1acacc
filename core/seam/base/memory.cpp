// SPDX-License-Identifier: BSD-3-Clause
#include "seam/base/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <fstream>

namespace seam {
namespace {

constexpr double megabyte = 1e6;

/// A line of a file of /proc, "VmSize:  123 kB", in bytes; 0 when there is none.
double bytes_of(const char* file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key + ":")) continue;
    const std::size_t digits = line.find_first_of("0123456789");
    return digits == std::string::npos ? 0 : 1024.0 * static_cast<double>(std::stoll(line.substr(digits)));
  }
  return 0;
}

}  // namespace

std::string describe_lack_of_memory(const std::string& what) {
  std::string text = fmt::format("out of memory for {}: this process holds {:.0f} MB", what,
                                 bytes_of("/proc/self/status", "VmRSS") / megabyte);
  if (const double free = bytes_of("/proc/meminfo", "MemAvailable"); free > 0)
    text += fmt::format(", {:.0f} MB of the machine are free", free / megabyte);
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    text += fmt::format(", and it may take no more than {:.0f} MB (see `ulimit -v`)",
                        static_cast<double>(limit.rlim_cur) / megabyte);
  return text + "; take a coarser mesh, a lower order, more processes or another machine";
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

double machine_memory() { return bytes_of("/proc/meminfo", "MemTotal"); }

}  // namespace seam
