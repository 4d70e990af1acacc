// SPDX-License-Identifier: BSD-3-Clause
// What MPI calls while a rank waits for another one, where there are more ranks than cores: this definition
// stands before that of the C library. Decision 54.
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <ctime>

namespace {

constexpr long too_long = 1'000'000;  ///< ns; who is alone on a core has it back a thousand times sooner
constexpr long nap = 3'000;           ///< ns
constexpr int naps = 200;

std::atomic<int> naps_left = 0;

long nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

/// Gives the core to others. Where these keep it, because they compute, a rank would wait for a slice of
/// theirs at each message. One that sleeps is woken within microseconds: after such a yield, sleep instead
/// for a while.
extern "C" __attribute__((visibility("default"))) int sched_yield() noexcept {
  if (naps_left > 0) {
    --naps_left;
    const timespec time{0, nap};
    nanosleep(&time, nullptr);
    return 0;
  }
  const long start = nanoseconds();
  syscall(SYS_sched_yield);
  if (nanoseconds() - start > too_long) {
    prctl(PR_SET_TIMERSLACK, 1000UL);  // or the kernel adds 50 us to each
    naps_left = naps;
  }
  return 0;
}
