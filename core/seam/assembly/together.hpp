// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "seam/base/communicator.hpp"

namespace seam {

/// Does work that exchanges nothing with other ranks, but may fail on some of them only: then it fails on
/// all, so that none waits for another. Collective.
/// @throws StepRefused on all ranks when it was refused on one and failed for no other reason; else what was
/// thrown here, or, where nothing was, an Error with the message of the lowest rank that failed
void together(const Communicator& communicator, const std::function<void()>& work);

}  // namespace seam
