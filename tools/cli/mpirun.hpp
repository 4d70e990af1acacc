// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace seam::cli {

/// Whether there is an mpirun on the PATH.
bool has_mpirun();

/// The words before a command that runs on so many ranks. In a process without MPI: an mpirun that is started
/// from within an MPI process refuses to work.
std::vector<std::string> mpirun(int ranks);

}  // namespace seam::cli
