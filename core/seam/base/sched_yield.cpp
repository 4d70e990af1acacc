// SPDX-License-Identifier: BSD-3-Clause
// What MPI calls while a rank waits for another one, where there are more ranks than cores: this definition
// stands before that of the C library. Decision 54.
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <ctime>

namespace {

constexpr long too_long = 1'000'000;  ///< ns; who is alone on a core has it back a thousand times sooner
constexpr long shortest_nap = 3'000;  ///< ns
constexpr long longest_nap = 100'000;
constexpr long same_wait =
    20'000;  ///< ns between a nap and the next call: who waits still has done nothing else
constexpr int naps = 200;

std::atomic<int> naps_left = 0;
std::atomic<long> nap = shortest_nap;
std::atomic<long> woken = 0;  ///< when the last nap ended

long nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

/// Gives the core to others. Where these keep it, because they compute, a rank would wait for a slice of
/// theirs at each message. One that sleeps is woken within microseconds: after such a yield, sleep instead
/// for a while. The longer a wait lasts, the less it matters when it is seen to end, and the more is left to
/// the others.
extern "C" __attribute__((visibility("default"))) int sched_yield() noexcept {
  const long start = nanoseconds();
  if (naps_left > 0) {
    --naps_left;
    nap = start - woken < same_wait ? std::min(nap * 5 / 4, longest_nap) : shortest_nap;
    const timespec time{0, nap};
    nanosleep(&time, nullptr);
    woken = nanoseconds();
    return 0;
  }
  syscall(SYS_sched_yield);
  woken = nanoseconds();
  if (woken - start > too_long) {
    prctl(PR_SET_TIMERSLACK, 1000UL);  // or the kernel adds 50 us to each
    naps_left = naps;
    nap = shortest_nap;
  }
  return 0;
}
