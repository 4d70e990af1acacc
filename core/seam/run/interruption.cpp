// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/interruption.hpp"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <csignal>
#include <ctime>
#include <string_view>

#include "seam/base/diagnostics.hpp"

namespace seam {
namespace {

constexpr std::array<int, 4> watched{SIGINT, SIGTERM, SIGHUP, SIGUSR1};
constexpr long long same_signal = 500'000'000;  // ns

// All that a handler may touch.
std::atomic<int> caught_signal{0};
std::atomic<long long> caught_at{0};  // ns
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<long long>::is_always_lock_free);

std::array<struct sigaction, watched.size()> before{};

long long nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000LL + now.tv_nsec;
}

/// Only calls that are allowed in a handler: it may come in the middle of anything.
void remember(int signal) {
  int none = 0;
  if (caught_signal.compare_exchange_strong(none, signal)) {
    caught_at = nanoseconds();
    return;
  }
  if (caught_at == 0 || nanoseconds() - caught_at < same_signal) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

SignalWatch::SignalWatch() {
  caught_signal = 0;
  caught_at = 0;
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  // One handler at a time, so that the two numbers it keeps belong together.
  for (const int signal : watched) sigaddset(&action.sa_mask, signal);
  for (std::size_t k = 0; k < watched.size(); ++k) {
    sigaction(watched[k], nullptr, &before[k]);
    if (before[k].sa_handler != SIG_IGN) sigaction(watched[k], &action, nullptr);
  }
}

SignalWatch::~SignalWatch() {
  for (std::size_t k = 0; k < watched.size(); ++k) sigaction(watched[k], &before[k], nullptr);
}

int SignalWatch::caught() { return caught_signal; }

std::string signal_name(int signal) {
  switch (signal) {
    case SIGINT:
      return "SIGINT";
    case SIGTERM:
      return "SIGTERM";
    case SIGHUP:
      return "SIGHUP";
    case SIGUSR1:
      return "SIGUSR1";
    default:
      return fmt::format("signal {}", signal);
  }
}

Attention agree(const Communicator& communicator, const Attention& mine) {
  if (communicator.size() == 1) return mine;
  std::array<int, 3> flags{mine.signal, mine.out_of_time ? 1 : 0, mine.restart_due ? 1 : 0};
  MPI_Allreduce(MPI_IN_PLACE, flags.data(), static_cast<int>(flags.size()), MPI_INT, MPI_MAX,
                communicator.handle());
  return {flags[0], flags[1] != 0, flags[2] != 0};
}

double parse_duration(const std::string& text) {
  const auto bad = [&] {
    return Error(
        fmt::format("'{}' is no duration; expected one like 90m, 1h30m, 2d or a number of seconds", text));
  };
  double seconds = 0;
  const char *at = text.data(), *const end = at + text.size();
  while (at < end) {
    double value = 0;
    const auto [next, code] = std::from_chars(at, end, value, std::chars_format::fixed);
    if (code != std::errc{} || !(value >= 0)) throw bad();
    constexpr std::string_view units = "dhms";
    constexpr std::array<double, 4> length{86400, 3600, 60, 1};
    // "1h30" would be thirty seconds to one and thirty minutes to another.
    const bool is_alone = next == end && at == text.data();
    const std::size_t unit = next == end ? (is_alone ? 3 : std::string_view::npos) : units.find(*next);
    if (unit == std::string_view::npos) throw bad();
    seconds += value * length.at(unit);
    at = next == end ? end : next + 1;
  }
  if (!(seconds > 0) || !std::isfinite(seconds)) throw bad();
  return seconds;
}

}  // namespace seam
