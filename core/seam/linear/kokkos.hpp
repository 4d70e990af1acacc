// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace seam {

/// Starts Kokkos, which Trilinos computes with, unless it runs already. It is left to the end of the process
/// to stop it: objects that hold its memory may live on after MPI is finalised.
void start_kokkos();

}  // namespace seam
