// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace seam::picture {

enum class Edges { automatic, on, off };

/// What the command line asks for.
struct Options {
  std::vector<std::string> files;  ///< .vtu, .pvtu or .pvd (its last step); all are drawn into one picture
  std::string output;              ///< .png
  std::string array;               ///< that gives the colour; "" for a plain body
  std::string component = "magnitude";
  std::string deform;  ///< vector array by which the bodies are displaced; "" for none
  double scale = 1;    ///< of that displacement
  std::string title;
  int width = 1200;  ///< pixels; the height follows from the shape of the bodies
  Edges edges = Edges::automatic;
  int streamlines = 0;        ///< that fit side by side into the shorter side of the picture; 0 for none
  std::string along;          ///< vector array they follow; "" for the array that gives the colour
  std::vector<double> range;  ///< of the colours; empty for that of the values
};

/// Reads the command line. @returns an exit code when there is nothing to draw (--help, or a mistake)
std::optional<int> parse_options(int argc, char** argv, Options& options);

}  // namespace seam::picture
