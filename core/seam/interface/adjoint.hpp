// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"

/// The adjoint term of a coupling by Nitsche's method, as scenes say it.
namespace seam {

/// Adds the key `adjoint`.
inline void declare_adjoint(Schema& schema) {
  schema
      .choice("adjoint", "Adjoint term: `skew` (xi = 1) is stable for every penalty",
              {"skew", "symmetric", "none"})
      .otherwise("skew");
}

/// xi of the key `adjoint`: +1 skew-symmetric, -1 symmetric, 0 none.
inline double adjoint_of(const Parameters& parameters) {
  const std::string& choice = parameters.text("adjoint");
  if (choice == "skew") return 1;
  return choice == "symmetric" ? -1 : 0;
}

}  // namespace seam
