// SPDX-License-Identifier: BSD-3-Clause
// A library that is called like a plugin and is none.
extern "C" [[gnu::visibility("default")]] int seam_test_answer() { return 42; }
