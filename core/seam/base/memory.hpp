// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "seam/base/diagnostics.hpp"

namespace seam {

/// There is not enough memory for something.
class OutOfMemory : public Error {
 public:
  using Error::Error;
};

/// "out of memory for WHAT: this process holds 3210 MB, ...", with what is known about the machine and its
/// limits. @param what is being done or built, "the mesh 'box'"
std::string describe_lack_of_memory(const std::string& what);

/// Largest resident memory of this process so far, bytes.
double peak_memory();

/// Of the machine, bytes; 0 where it does not say.
double machine_memory();

/// Calls `work`; where it lacks memory, says for what. @param where in the scene
template <class Work>
auto needing_memory(const std::string& what, const Location& where, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const std::bad_alloc&) {
    throw OutOfMemory(where, describe_lack_of_memory(what));
  } catch (const std::length_error&) {
    // What containers say when they are to hold more than any machine can.
    throw OutOfMemory(where, describe_lack_of_memory(what));
  }
}

}  // namespace seam
