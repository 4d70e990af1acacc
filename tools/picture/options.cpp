// SPDX-License-Identifier: BSD-3-Clause
#include "options.hpp"

#include <CLI/CLI.hpp>
#include <map>

namespace seam::picture {

std::optional<int> parse_options(int argc, char** argv, Options& o) {
  CLI::App app("Draws results of Seam into a PNG file, with or without a screen.", "seam-picture");
  std::vector<std::string> names;
  app.add_option("files", names,
                 "FILE.{vtu,pvtu,pvd} ... OUT.png: results (of a .pvd the last step), then the picture")
      ->required()
      ->expected(2, 100);
  app.add_option("-a,--array", o.array, "array that gives the colour");
  app.add_option("-c,--component", o.component, "magnitude, x, y, z or a number from 0 (default: magnitude)");
  app.add_option("-d,--deform", o.deform, "vector array by which the bodies are displaced");
  app.add_option("-s,--scale", o.scale, "factor on that displacement (default: 1)");
  app.add_option("-t,--title", o.title, "line above the picture");
  app.add_option("-w,--width", o.width, "width in pixels (default: 1200)")->check(CLI::Range(200, 10000));
  app.add_option("--range", o.range, "lowest and highest value of the colours")->expected(2);
  app.add_option(
         "--streamlines", o.streamlines,
         "draw streamlines, so dense that this many fit into the shorter side; of spatial results on a "
         "slice through the middle")
      ->check(CLI::Range(1, 1000));
  app.add_option("--along", o.along, "vector array the streamlines follow (default: that of the colour)");
  const std::map<std::string, Edges> edges = {
      {"auto", Edges::automatic}, {"on", Edges::on}, {"off", Edges::off}};
  std::string edge_word = "auto";
  app.add_option(
         "-e,--edges", edge_word,
         "edges of cells: on, off or auto (when cells are few and there are no streamlines; the default)")
      ->check(CLI::IsMember({"auto", "on", "off"}))
      ->expected(0, 1)
      ->default_str("on");
  try {
    app.parse(argc, argv);
    o.output = names.back();
    if (!o.output.ends_with(".png"))
      throw CLI::ValidationError("files",
                                 "the last file is '" + o.output + "'; expected a name that ends in .png");
  } catch (const CLI::ParseError& e) {
    return app.exit(e);
  }
  names.pop_back();
  o.files = std::move(names);
  o.edges = edges.at(edge_word.empty() ? "on" : edge_word);
  return std::nullopt;
}

}  // namespace seam::picture
