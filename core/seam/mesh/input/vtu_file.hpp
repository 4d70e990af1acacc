// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace seam {

/// The contents of a VTU file with one piece.
///
/// Seam decodes these files itself: VTK's reader trusts the sizes and offsets that a file claims, and a
/// broken one makes it allocate without bound or read out of bounds.
struct VtuFile {
  struct Array {
    int components = 1;
    std::vector<double> values;      ///< numbers (exact up to 2^53), `components` per tuple
    std::vector<std::string> words;  ///< of an array of strings instead
  };
  std::size_t points = 0;
  std::size_t cells = 0;
  /// By section (Points, Cells, PointData, CellData) and name; the array of Points has the name "".
  std::map<std::pair<std::string, std::string>, Array> arrays;
};

/// Decodes the text of a VTU file: arrays in ASCII, base64 or raw, inline or appended, plain or compressed by
/// zlib or LZ4. Only Points, Cells and the cell array "region" are decoded.
/// @throws Error with file, and what does not fit together
VtuFile parse_vtu(const std::string& text, const std::string& name);

}  // namespace seam
