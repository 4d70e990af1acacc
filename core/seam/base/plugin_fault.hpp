// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <new>
#include <string>
#include <typeinfo>

#include "seam/base/diagnostics.hpp"

namespace seam {

/// Code of a plugin threw what it should not, or asks for what there is not. The message names the plugin,
/// what it was asked for, and where the scene asked.
class PluginFault : public Error {
 public:
  using Error::Error;
};

/// " of plugin 'solid'" for an address in a plugin's library; "" for one of Seam itself or of no library.
std::string of_plugin(const void* address);

/// The same for an object, by where the virtual table of its class lies.
template <class T>
std::string plugin_of(const T& object) {
  static_assert(std::is_polymorphic_v<T>);
  return of_plugin(*reinterpret_cast<const void* const*>(dynamic_cast<const void*>(&object)));
}

/// What the exception of the catch block this is called in says: its text, and the type of those that are no
/// seam::Error.
std::string text_of_exception();

/// Calls code of a plugin. What a user can mend (seam::Error) gets the place in the scene, where it has none;
/// steps refused and lack of memory pass; anything else is a PluginFault.
/// @param what "field 'bad' of plugin 'broken'": called only where something is thrown
template <class Describe, class Action>
auto call_plugin(const Location& where, Describe&& what, Action&& action) {
  try {
    return action();
  } catch (const StepRefused&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const Error& error) {
    const std::string place = where.text();
    if (typeid(error) != typeid(Error) || place.empty() || std::string(error.what()).starts_with(where.file))
      throw;
    throw Error(where, error.what());
  } catch (...) {
    throw PluginFault(where, what() + " failed: " + text_of_exception());
  }
}

}  // namespace seam
