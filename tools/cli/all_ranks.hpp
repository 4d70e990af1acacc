// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace seam::cli {

/// Starts MPI, calls the action on every rank and ends MPI.
/// An exception on all ranks is printed once and becomes the exit code; one on some ranks only is printed and
/// ends all processes, as the others would wait for those for ever.
/// @param action gets whether this is the rank that prints; returns an ExitCode
int run_on_all_ranks(const std::function<int(bool is_root)>& action);

/// Within a catch block of code that all ranks run: returns when all ranks are in such a block (so that they
/// may go on together, with the same message), else prints the exception and ends all processes.
/// @returns the distinct messages of all ranks, one after the other
std::string agree_on_exception();

}  // namespace seam::cli
