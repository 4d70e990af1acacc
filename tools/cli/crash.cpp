// SPDX-License-Identifier: BSD-3-Clause
#include "crash.hpp"

#include <dlfcn.h>
#include <execinfo.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <utility>

namespace seam::cli {
namespace {

constexpr std::array signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL};

/// The address sanitizer explains crashes itself, and better.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool explained_elsewhere = true;
#else
constexpr bool explained_elsewhere = false;
#endif

/// Async-signal-safe, as all below is but for dladdr(): the process is lost anyway.
void say(const char* text) { static_cast<void>(write(STDERR_FILENO, text, std::strlen(text))); }

/// The name behind "libseam_" of a plugin's library, up to ".so"; its length is 0 for any other file.
std::pair<const char*, std::size_t> plugin_in(const char* file) {
  const char* slash = std::strrchr(file, '/');
  const char* name = slash ? slash + 1 : file;
  constexpr std::size_t start = 8, end = 3;
  const std::size_t length = std::strlen(name);
  if (length <= start + end || std::strncmp(name, "libseam_", start) != 0 ||
      std::strcmp(name + length - end, ".so") != 0)
    return {name, 0};
  return {name + start, length - start - end};
}

void explain(int signal) {
  std::array<void*, 64> frames{};
  const int count = backtrace(frames.data(), static_cast<int>(frames.size()));
  say("error: a crash (");
  say(strsignal(signal));
  bool found = false;
  for (int k = 0; k < count && !found; ++k) {
    Dl_info info{};
    if (dladdr(frames[static_cast<std::size_t>(k)], &info) == 0 || !info.dli_fname) continue;
    const auto [name, length] = plugin_in(info.dli_fname);
    if (length == 0) continue;
    found = true;
    say(") within plugin '");
    static_cast<void>(write(STDERR_FILENO, name, length));
    say("': a defect of the plugin; `seam plugin test` may say where\n");
  }
  if (!found)
    say(") within Seam itself or a library that it uses: a defect; please report it with the scene\n");
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void explain_crashes() {
  if constexpr (explained_elsewhere) return;
  // Both are loaded at their first use, which must not be in a handler; the stack may be what has overflown.
  std::array<void*, 1> frame{};
  backtrace(frame.data(), 1);
  static std::array<char, 1 << 16> own_stack;
  stack_t stack{};
  stack.ss_sp = own_stack.data();
  stack.ss_size = own_stack.size();
  sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_handler = explain;
  action.sa_flags = SA_ONSTACK | SA_RESETHAND | SA_NODEFER;
  for (const int signal : signals) sigaction(signal, &action, nullptr);
}

}  // namespace seam::cli
