// SPDX-License-Identifier: BSD-3-Clause
// Holds what the core and the plugins include of others, precompiled: CMakeLists.txt lists it.
