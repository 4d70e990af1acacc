// SPDX-License-Identifier: BSD-3-Clause
#include "seam/term/term_name.hpp"

#include <cxxabi.h>

#include <cstdlib>
#include <memory>
#include <typeinfo>

namespace seam {

std::string term_name(const Term& term) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> text(
      abi::__cxa_demangle(typeid(term).name(), nullptr, nullptr, &status), &std::free);
  std::string name = status == 0 ? text.get() : typeid(term).name();
  for (const std::string wrapper : {"seam::KernelTerm<", "seam::KernelQuantity<"})
    if (name.starts_with(wrapper)) name = name.substr(wrapper.size(), name.size() - wrapper.size() - 1);
  // "Kernel<1> >": of templates.
  while (name.ends_with(' ')) name.pop_back();
  const std::string hidden = "(anonymous namespace)::";
  for (std::size_t at = 0; (at = name.find(hidden, at)) != std::string::npos;) name.erase(at, hidden.size());
  return name;
}

}  // namespace seam
