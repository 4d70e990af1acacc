// SPDX-License-Identifier: BSD-3-Clause
#include "seam/preconditioner/library.hpp"

const seam::PreconditionerLibrary* seam_preconditioner_library() {
  static const seam::PreconditionerLibrary library{seam::build_multigrid, seam::build_incomplete_lu};
  return &library;
}
