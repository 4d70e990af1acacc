// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <set>

#include "seam/mesh/input/gmsh_file.hpp"
#include "seam/mesh/input/text_reader.hpp"

namespace seam {

namespace {

constexpr long long largest_int = std::numeric_limits<int>::max();
// "1 " and "0 0 0 ": the fewest characters that a tag and a position take.
constexpr std::size_t tag_bytes = 2, position_bytes = 6;

/// From the tags of nodes to where they stand in the file.
class NodeIndex {
 public:
  NodeIndex() = default;
  explicit NodeIndex(const std::vector<long long>& tags) {
    entries_.reserve(tags.size());
    for (std::size_t i = 0; i < tags.size(); ++i) entries_.emplace_back(tags[i], static_cast<int>(i));
    std::sort(entries_.begin(), entries_.end());
    // Tags without gaps, as Gmsh mostly writes them, need no search.
    dense_ = !entries_.empty() &&
             entries_.back().first - entries_.front().first == static_cast<long long>(entries_.size()) - 1;
  }
  [[nodiscard]] int find(long long tag) const {
    if (entries_.empty() || tag < entries_.front().first || tag > entries_.back().first) return -1;
    if (dense_) return entries_[tag - entries_.front().first].second;
    const auto at = std::lower_bound(entries_.begin(), entries_.end(), std::pair(tag, 0));
    return at != entries_.end() && at->first == tag ? at->second : -1;
  }
  /// A tag that occurs twice, or 0.
  [[nodiscard]] long long repeated() const {
    for (std::size_t i = 1; i < entries_.size(); ++i)
      if (entries_[i].first == entries_[i - 1].first) return entries_[i].first;
    return 0;
  }

 private:
  std::vector<std::pair<long long, int>> entries_;
  bool dense_ = false;
};

class Parser {
 public:
  Parser(const std::string& text, const std::string& name) : in_(text, name) {}

  GmshFile parse() {
    if (in_.at_end()) in_.fail("the file is empty; expected a Gmsh mesh");
    if (const auto first = in_.word("$MeshFormat"); first != "$MeshFormat")
      in_.fail("the file does not start with $MeshFormat, so it is not a Gmsh mesh of format 2.2 or 4.1");
    format();
    while (!in_.at_end()) {
      const int line = in_.line();
      section(std::string(in_.word("a section")), line);
    }
    for (const char* needed : {"$Nodes", "$Elements"})
      if (!seen_.contains(needed))
        in_.fail(fmt::format("the file ends without a {} section; it seems to be truncated", needed));
    return std::move(file_);
  }

 private:
  void format() {
    const double version = in_.number("the version of the format");
    const long long binary = in_.integer("the kind of file (0 for ASCII)");
    if (version != 2.2 && version != 4.1)
      in_.fail(
          fmt::format("the file has Gmsh format {}, but only 2.2 and 4.1 can be read; save it with Mesh."
                      "MshFileVersion = 4.1",
                      version));
    if (binary != 0) in_.fail("the file is binary, but only ASCII can be read; save it with Mesh.Binary = 0");
    in_.integer("the size of a floating-point number");
    old_ = version == 2.2;
    end("$EndMeshFormat");
  }

  void end(const char* mark) {
    const auto word = in_.word(mark);
    if (word != mark) in_.fail(fmt::format("expected {} at the end of the section", mark));
  }

  void section(const std::string& name, int line) {
    if (name.size() < 2 || name[0] != '$')
      in_.fail_at(
          line,
          "expected the start of a section, such as $Nodes; the section before this line has more in it "
          "than its header says");
    if (name == "$PartitionedEntities")
      in_.fail_at(line, "the mesh is partitioned; save it as a whole: Seam distributes it among processes");
    const bool known =
        name == "$PhysicalNames" || name == "$Entities" || name == "$Nodes" || name == "$Elements";
    const std::string mark = "$End" + name.substr(1);
    if (!known) return in_.skip_past(mark);
    if (!seen_.insert(name).second) in_.fail_at(line, fmt::format("there is a second {} section", name));
    if (name == "$PhysicalNames") physical_names();
    if (name == "$Entities")
      old_ ? in_.fail_at(line, "$Entities does not belong into format 2.2") : entities();
    if (name == "$Nodes") old_ ? old_nodes() : nodes();
    if (name == "$Elements") {
      if (!seen_.contains("$Nodes")) in_.fail_at(line, "$Elements stands before $Nodes");
      old_ ? old_elements() : elements();
    }
    end(mark.c_str());
  }

  void physical_names() {
    const std::size_t n = in_.count("the number of physical names", 7);
    for (std::size_t i = 0; i < n; ++i) {
      const int dimension = static_cast<int>(in_.integer("the dimension of a physical group", 0, 3));
      const int tag = static_cast<int>(in_.integer("the tag of a physical group", -largest_int, largest_int));
      file_.group_names[{dimension, std::abs(tag)}] = in_.quoted("the name of a physical group");
    }
  }

  // ---- format 4.1 ----

  void entities() {
    std::array<std::size_t, 4> counts{};
    for (auto& n : counts) n = in_.count("the number of geometric entities", tag_bytes);
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < counts[dimension]; ++i) entity(dimension);
  }

  void entity(int dimension) {
    const long long tag = in_.integer("the tag of an entity");
    for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) in_.number("a bound of an entity");
    auto& groups = entity_groups_[{dimension, tag}];
    const std::size_t n = in_.count("the number of an entity's physical groups", tag_bytes);
    // Every group lists all its elements, so a broken file with many groups could ask for any amount of
    // memory.
    if (n > 100) in_.fail(fmt::format("an entity is in {} physical groups; expected at most 100", n));
    for (std::size_t i = 0; i < n; ++i) groups.push_back(group("the tag of a physical group"));
    if (dimension == 0) return;
    const std::size_t bounding = in_.count("the number of an entity's boundaries", tag_bytes);
    for (std::size_t i = 0; i < bounding; ++i) in_.integer("the tag of a boundary");
  }

  /// The sign of a tag is the orientation of the entity in its group.
  int group(const char* what) {
    return std::abs(static_cast<int>(in_.integer(what, -largest_int, largest_int)));
  }

  void nodes() {
    const std::size_t blocks = in_.count("the number of node blocks", tag_bytes);
    const std::size_t total = in_.count("the number of nodes", tag_bytes + position_bytes);
    in_.integer("the lowest tag of a node");
    in_.integer("the highest tag of a node");
    for (std::size_t b = 0; b < blocks; ++b) node_block();
    finish_nodes(total);
  }

  void node_block() {
    const int dimension = static_cast<int>(in_.integer("the dimension of an entity", 0, 3));
    in_.integer("the tag of an entity");
    const bool parametric = in_.integer("'parametric'", 0, 1) == 1;
    const std::size_t n = in_.count("the number of nodes of a block", tag_bytes + position_bytes);
    for (std::size_t i = 0; i < n; ++i) file_.node_tags.push_back(in_.integer("the tag of a node"));
    for (std::size_t i = 0; i < n; ++i) {
      position();
      for (int k = 0; parametric && k < dimension; ++k) in_.number("a parametric coordinate");
    }
  }

  void position() {
    auto& x = file_.node_positions.emplace_back();
    for (double& xi : x) xi = in_.number("a coordinate");
  }

  void finish_nodes(std::size_t claimed) {
    const std::size_t n = file_.node_tags.size();
    if (n != claimed) in_.fail(fmt::format("$Nodes announces {} nodes but has {}", claimed, n));
    // Three coordinates per node are counted in int later on.
    if (n > static_cast<std::size_t>(largest_int) / 3)
      in_.fail("the mesh has more nodes than can be counted");
    index_ = NodeIndex(file_.node_tags);
    if (const long long tag = index_.repeated()) in_.fail(fmt::format("node {} is there twice", tag));
  }

  void elements() {
    const std::size_t blocks = in_.count("the number of element blocks", tag_bytes);
    const std::size_t total = in_.count("the number of elements", 2 * tag_bytes);
    in_.integer("the lowest tag of an element");
    in_.integer("the highest tag of an element");
    std::size_t found = 0;
    for (std::size_t b = 0; b < blocks; ++b) found += element_block();
    if (found != total) in_.fail(fmt::format("$Elements announces {} elements but has {}", total, found));
  }

  std::size_t element_block() {
    const int dimension = static_cast<int>(in_.integer("the dimension of an entity", 0, 3));
    const long long tag = in_.integer("the tag of an entity");
    const GmshElementType type = element_type(in_.integer("the type of the elements"));
    if (topology(type.type).dimension != dimension)
      in_.fail(fmt::format("{}s in an entity of dimension {}", name(type.type), dimension));
    const std::size_t n = in_.count("the number of elements of a block", tag_bytes * (1 + type.nodes));
    const auto groups = entity_groups_.find({dimension, tag});
    GmshFile::Elements block{
        type, groups == entity_groups_.end() ? std::vector<int>{} : groups->second, {}, 0};
    for (std::size_t i = 0; i < n; ++i) {
      in_.integer("the tag of an element");
      if (i == 0) block.line = in_.line();
      element_nodes(block);
    }
    if (n > 0) file_.elements.push_back(std::move(block));
    return n;
  }

  void element_nodes(GmshFile::Elements& block) {
    for (int a = 0; a < block.type.nodes; ++a) {
      const long long tag = in_.integer("a node of an element");
      const int node = index_.find(tag);
      if (node < 0) in_.fail(fmt::format("an element names node {}, which is not in $Nodes", tag));
      block.nodes.push_back(node);
    }
  }

  GmshElementType element_type(long long number) {
    switch (number) {
      case 1:
        return {CellType::segment, 1, 2};
      case 2:
        return {CellType::triangle, 1, 3};
      case 3:
        return {CellType::quadrilateral, 1, 4};
      case 4:
        return {CellType::tetrahedron, 1, 4};
      case 5:
        return {CellType::hexahedron, 1, 8};
      case 8:
        return {CellType::segment, 2, 3};
      case 9:
        return {CellType::triangle, 2, 6};
      case 10:
        return {CellType::quadrilateral, 2, 9};
      case 11:
        return {CellType::tetrahedron, 2, 10};
      case 12:
        return {CellType::hexahedron, 2, 27};
      case 15:
        return {CellType::point, 1, 1};
      case 6:
      case 13:
      case 18:
        in_.fail(
            "the mesh has prisms; expected triangles, quadrilaterals, tetrahedra or "
            "hexahedra only");
      case 7:
      case 14:
      case 19:
        in_.fail(
            "the mesh has pyramids; expected triangles, quadrilaterals, tetrahedra or "
            "hexahedra only");
      case 16:
      case 17:
        in_.fail(
            "the mesh has serendipity elements (8-node quadrilaterals or 20-node hexahedra); "
            "save it with Mesh.SecondOrderIncomplete = 0");
      default:
        in_.fail(
            fmt::format("element type {} is not known; expected segments, triangles, quadrilaterals, "
                        "tetrahedra or hexahedra of order 1 or 2 (Mesh.ElementOrder)",
                        number));
    }
  }

  // ---- format 2.2 ----

  void old_nodes() {
    const std::size_t n = in_.count("the number of nodes", tag_bytes + position_bytes);
    for (std::size_t i = 0; i < n; ++i) {
      file_.node_tags.push_back(in_.integer("the tag of a node"));
      position();
    }
    finish_nodes(n);
  }

  void old_elements() {
    const std::size_t n = in_.count("the number of elements", 4 * tag_bytes);
    for (std::size_t i = 0; i < n; ++i) {
      in_.integer("the tag of an element");
      const int line = in_.line();
      const GmshElementType type = element_type(in_.integer("the type of an element"));
      const std::size_t tags = in_.count("the number of an element's tags", tag_bytes);
      int physical = 0;
      for (std::size_t t = 0; t < tags; ++t) {
        const int tag = group("a tag of an element");
        if (t == 0) physical = tag;
      }
      const std::vector<int> groups = physical == 0 ? std::vector<int>{} : std::vector<int>{physical};
      if (file_.elements.empty() || file_.elements.back().type.type != type.type ||
          file_.elements.back().type.order != type.order || file_.elements.back().groups != groups)
        file_.elements.push_back({type, groups, {}, line});
      element_nodes(file_.elements.back());
    }
  }

  TextReader in_;
  GmshFile file_;
  NodeIndex index_;
  std::map<std::pair<int, long long>, std::vector<int>> entity_groups_;
  std::set<std::string> seen_;
  bool old_ = false;
};

}  // namespace

GmshFile parse_gmsh(const std::string& text, const std::string& name) { return Parser(text, name).parse(); }

}  // namespace seam
