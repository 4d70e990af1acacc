// SPDX-License-Identifier: BSD-3-Clause
// seam-picture: draws results into a PNG file.
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <vector>

#include "load.hpp"
#include "options.hpp"
#include "render.hpp"
#include "seam/base/diagnostics.hpp"

namespace {

/// VTK needs an X server even to draw off screen: without one, the program starts itself again within a
/// virtual one. Returns only when that fails.
void restart_with_virtual_screen(char** argv) {
  setenv("SEAM_PICTURE_VIRTUAL_SCREEN", "1", 1);
  std::vector<char*> command;
  std::string words[] = {"xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", "/proc/self/exe"};
  char self[4096];
  if (const auto n = readlink("/proc/self/exe", self, sizeof(self) - 1); n > 0)
    words[4] = std::string(self, n);
  for (auto& w : words) command.push_back(w.data());
  for (char** a = argv + 1; *a; ++a) command.push_back(*a);
  command.push_back(nullptr);
  execvp(command[0], command.data());
}

}  // namespace

int main(int argc, char** argv) {
  seam::picture::Options options;
  if (const auto code = parse_options(argc, argv, options)) return *code;
  if (!std::getenv("DISPLAY")) {
    if (!std::getenv("SEAM_PICTURE_VIRTUAL_SCREEN")) restart_with_virtual_screen(argv);
    std::cerr << "seam-picture: there is no screen (DISPLAY is not set) and xvfb-run does not start one: "
              << std::strerror(errno) << "; install the package xvfb\n";
    return 1;
  }
  try {
    render(seam::picture::load_bodies(options), options);
  } catch (const std::exception& e) {
    std::cerr << "seam-picture: " << e.what() << '\n';
    return 1;
  }
  return 0;
}
