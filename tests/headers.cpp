// SPDX-License-Identifier: BSD-3-Clause
// Holds what all tests include, precompiled: CMakeLists.txt lists it.
