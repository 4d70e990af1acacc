// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "seam/base/communicator.hpp"
#include "seam/base/memory.hpp"
#include "seam/base/plugin_fault.hpp"

namespace seam {

/// The errors of parts that are built one after the other, so that a user sees all of them at once.
class ErrorList {
 public:
  explicit ErrorList(const Communicator& communicator) : goes_on_(communicator.size() == 1) {}
  /// Builds a part; what is wrong with it is kept. On several ranks it is thrown: the others may be within a
  /// collective operation.
  template <class Action>
  void attempt(Action&& action) {
    try {
      action();
    } catch (const OutOfMemory&) {
      throw;
    } catch (const PluginFault&) {
      throw;
    } catch (const Error& error) {
      if (!goes_on_) throw;
      text_ += (text_.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  /// @throws Error with all that was kept, a line each
  void throw_if_any() const {
    if (!text_.empty()) throw Error(text_);
  }

 private:
  bool goes_on_;
  std::string text_;
};

}  // namespace seam
