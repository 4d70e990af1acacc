// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/kokkos.hpp"

#include <Kokkos_Core.hpp>

namespace seam {

void start_kokkos() {
  if (!Kokkos::is_initialized()) Kokkos::initialize();
}

}  // namespace seam
