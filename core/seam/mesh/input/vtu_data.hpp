// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace seam {

/// How a VTK XML file stores its binary arrays.
struct VtuEncoding {
  enum class Compressor { none, zlib, lz4 };
  std::size_t header_bytes = 4;  ///< of one number in a block's header: 4 or 8
  Compressor compressor = Compressor::none;
};

/// What is wrong with binary data; the caller knows the place.
struct VtuDataError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Decodes one binary array.
/// @param text begins with the array; what it claims must fit into it
/// @param base64 false for raw bytes
/// @param expected number of bytes the array must have; `any_size` when it may have any
/// @throws VtuDataError
std::vector<unsigned char> decode_vtu_data(std::string_view text, bool base64, const VtuEncoding& encoding,
                                           std::size_t expected);
constexpr std::size_t any_size = static_cast<std::size_t>(-1);

}  // namespace seam
