// SPDX-License-Identifier: BSD-3-Clause
#include <dlfcn.h>
#include <sched.h>

#include <catch2/catch.hpp>

TEST_CASE("a rank that waits is given the core's way to wait, not the C library's") {
  Dl_info found{};
  REQUIRE(dladdr(dlsym(RTLD_DEFAULT, "sched_yield"), &found) != 0);
  CHECK_THAT(found.dli_fname, Catch::Contains("libseam_core"));
  for (int i = 0; i < 1000; ++i) REQUIRE(sched_yield() == 0);
}
