// SPDX-License-Identifier: BSD-3-Clause
#include "seam/assembly/together.hpp"

#include <exception>
#include <string>

#include "seam/base/all_or_none.hpp"
#include "seam/base/plugin_fault.hpp"

namespace seam {
namespace {

enum Outcome : int { done, refused, failed, failed_in_plugin };

}  // namespace

void together(const Communicator& communicator, const std::function<void()>& work) {
  if (communicator.size() == 1) {
    work();
    return;
  }
  std::exception_ptr thrown;
  std::string message;
  Outcome outcome = done;
  try {
    work();
  } catch (const StepRefused& error) {
    outcome = refused;
    message = error.what();
  } catch (const PluginFault& error) {
    outcome = failed_in_plugin;
    message = error.what();
    thrown = std::current_exception();
  } catch (const std::exception& error) {
    outcome = failed;
    message = error.what();
    thrown = std::current_exception();
  } catch (...) {
    outcome = failed;
    message = "something was thrown that is no std::exception";
    thrown = std::current_exception();
  }
  const int worst = communicator.max(outcome);
  if (worst == done) return;
  message = distinct_texts(communicator, outcome == worst ? message : "");
  if (worst == refused) throw StepRefused(message);
  if (thrown) std::rethrow_exception(thrown);
  if (worst == failed_in_plugin) throw PluginFault(message);
  throw Error(message);
}

}  // namespace seam
