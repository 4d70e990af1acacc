// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace seam {

class Registry;

void register_periodic(Registry& registry);
void register_symmetry(Registry& registry);
void register_tied(Registry& registry);

}  // namespace seam
