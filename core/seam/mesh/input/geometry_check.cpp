// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/input/geometry_check.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <filesystem>
#include <set>
#include <string_view>
#include <vector>

#include "seam/base/diagnostics.hpp"
#include "seam/base/policy.hpp"
#include "seam/mesh/input/read_text.hpp"

namespace seam {
namespace {

namespace fs = std::filesystem;

/// Words after which another word, a number or a text may stand. None of them starts, reads or writes
/// anything.
const std::set<std::string, std::less<>> harmless = {
    // entities and operations
    "Affine", "BSpline", "Bezier", "Block", "BooleanDifference", "BooleanFragments", "BooleanIntersection",
    "BooleanUnion", "Boundary", "BoundingBox", "Box", "CenterOfMass", "Chamfer", "Circle", "Coherence",
    "CombinedBoundary", "Compound", "Cone", "Coordinates", "Curve", "Cylinder", "Delete", "Dilate", "Disk",
    "Duplicata", "Ellipse", "Ellipsis", "Extrude", "Fillet", "Hole", "Intersect", "Layers", "Line", "Loop",
    "Nurbs", "Parent", "Periodic", "Physical", "Plane", "Point", "PointsOf", "Rectangle", "Rotate", "Ruled",
    "Slide", "Sphere", "Spline", "Surface", "Symmetry", "Tag", "ThruSections", "Torus", "Translate", "Volume",
    "Wedge", "Wire",
    // the mesh
    "Bump", "Beta", "Color", "Embed", "Field", "Characteristic", "Length", "Mesh", "MeshAlgorithm",
    "MeshSize", "MeshSizeFromBoundary", "Progression", "QuadTriAddVerts", "QuadTriNoNewVerts",
    "RecombLaterals", "Recombine", "RecombineMesh", "RefineMesh", "Reverse", "ReverseMesh", "ScaleLastLayer",
    "Smoother", "Transfinite", "TransfQuadTri", "Using", "Alternate", "AlternateRight", "AlternateLeft",
    "Left", "Right", "In", "Background", "OptimizeMesh",
    // the language
    "Call", "DefineConstant", "DefineNumber", "Else", "ElseIf", "EndFor", "EndIf", "Exit", "For", "Function",
    "If", "Macro", "Model", "Physicals", "Return", "SetFactory", "Str", "StrCat", "Unique",
    // what describes a constant
    "AutoCheck", "Choices", "Closed", "Help", "Highlight", "Label", "Max", "Min", "Name", "ReadOnly", "Step",
    "Units", "Visible"};

/// Words that start programs, open or write files, or change what others do.
const std::set<std::string, std::less<>> refused = {"SystemCall",
                                                    "NonBlockingSystemCall",
                                                    "OnelabRun",
                                                    "OnelabAction",
                                                    "SetChanged",
                                                    "Save",
                                                    "Print",
                                                    "Plugin",
                                                    "ShapeFromFile",
                                                    "ListFromFile",
                                                    "ExternalProcess",
                                                    "CommandLine",
                                                    "FileName",
                                                    "Structured",
                                                    "PostView",
                                                    "NewModel",
                                                    "SyncModel",
                                                    "Parametric",
                                                    "GetEnv",
                                                    "FileExists",
                                                    "GetString",
                                                    "GetStringValue",
                                                    "GetNumber",
                                                    "GetForced",
                                                    "GetForcedStr",
                                                    "SetString",
                                                    "SetNumber",
                                                    "DefineString",
                                                    "StringToName",
                                                    "S2N",
                                                    "NameToString",
                                                    "N2S",
                                                    "CopyOptions",
                                                    "Alias",
                                                    "AliasWithOptions",
                                                    "Combine",
                                                    "Draw",
                                                    "Solver",
                                                    "View",
                                                    "PostProcessing",
                                                    "CreateDir",
                                                    "Parse",
                                                    "ParseStrings",
                                                    "OpenFile",
                                                    "Homology",
                                                    "Cohomology",
                                                    "Levelset"};

const std::set<std::string, std::less<>> harmless_fields = {"Attractor",
                                                            "AttractorAnisoCurve",
                                                            "AutomaticMeshSizeField",
                                                            "Ball",
                                                            "BoundaryLayer",
                                                            "Box",
                                                            "Constant",
                                                            "Curvature",
                                                            "Cylinder",
                                                            "Distance",
                                                            "Extend",
                                                            "Frustum",
                                                            "Gradient",
                                                            "IntersectAniso",
                                                            "Laplacian",
                                                            "LonLat",
                                                            "MathEval",
                                                            "Max",
                                                            "MaxEigenHessian",
                                                            "Mean",
                                                            "Min",
                                                            "MinAniso",
                                                            "Octree",
                                                            "Param",
                                                            "Restrict",
                                                            "Threshold"};

const std::set<std::string, std::less<>> harmless_general = {"AbortOnError", "ExpertMode", "NumThreads",
                                                             "Terminal", "Verbosity"};

/// CAD files that gmsh knows by these endings. Of others it looks at the content, and takes it for a
/// geometry.
const std::set<std::string, std::less<>> harmless_endings = {".step", ".stp", ".brep",
                                                             ".iges", ".igs", ".stl"};

struct Token {
  enum class Kind { word, number, text, sign };
  Kind kind;
  std::string value;
  int line;
};

[[noreturn]] void refuse(const std::string& path, int line, const std::string& what) {
  throw Error(
      Location{path, line, 0},
      fmt::format("{}; a geometry may only describe shapes and their meshes, as it is a program. Take it "
                  "out, mesh the geometry elsewhere and name the .msh file, or, when you trust "
                  "its author, allow it by --trust-geometry",
                  what));
}

/// Cuts a geometry into words, numbers, texts and signs, exactly as gmsh does: what it takes for a text or a
/// remark must not be code there, or the other way round.
class Lexer {
 public:
  Lexer(const std::string& text, const std::string& path) : text_(text), path_(path) {}

  std::vector<Token> tokens() {
    for (std::size_t i = 0; i < text_.size(); ++i) {
      const auto c = static_cast<unsigned char>(text_[i]);
      // Gmsh ends remarks and texts at such characters, whatever follows.
      if ((c < 0x20 && c != '\n' && c != '\t' && c != '\r' && c != '\f') || c == 0x7f)
        refuse(path_, line_of(i), fmt::format("found the control character 0x{:02x}", c));
    }
    while (at_ < text_.size()) take();
    return std::move(tokens_);
  }

 private:
  [[nodiscard]] int line_of(std::size_t offset) const {
    int line = 1;
    for (std::size_t i = 0; i < offset; ++i) line += text_[i] == '\n' ? 1 : 0;
    return line;
  }

  void add(Token::Kind kind, std::size_t end) {
    tokens_.push_back({kind, text_.substr(at_, end - at_), line_});
    move_to(end);
  }

  void move_to(std::size_t end) {
    for (; at_ < end; ++at_) line_ += text_[at_] == '\n' ? 1 : 0;
  }

  void take() {
    const char c = text_[at_];
    const auto is_letter = [](char a) {
      return std::isalpha(static_cast<unsigned char>(a)) != 0 || a == '_';
    };
    const auto is_digit = [](char a) { return std::isdigit(static_cast<unsigned char>(a)) != 0; };
    std::size_t end = at_ + 1;
    if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      move_to(end);
    } else if (text_.compare(at_, 2, "//") == 0) {
      move_to(std::min(text_.size(), text_.find('\n', at_)));
    } else if (text_.compare(at_, 2, "/*") == 0) {
      const std::size_t close = text_.find("*/", at_ + 2);
      if (close == std::string::npos) refuse(path_, line_, "found a remark ('/*') that does not end");
      move_to(close + 2);
    } else if (c == '"' || c == '\'') {
      take_text(c);
    } else if (is_letter(c)) {
      while (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]))) ++end;
      add(Token::Kind::word, end);
    } else if (is_digit(c) || (c == '.' && end < text_.size() && is_digit(text_[end]))) {
      while (end < text_.size() && (is_digit(text_[end]) || text_[end] == '.')) ++end;
      take_exponent(end);
      add(Token::Kind::number, end);
    } else {
      add(Token::Kind::sign, end);
    }
  }

  void take_exponent(std::size_t& end) const {
    std::size_t next = end;
    if (next >= text_.size() || (text_[next] != 'e' && text_[next] != 'E')) return;
    ++next;
    if (next < text_.size() && (text_[next] == '+' || text_[next] == '-')) ++next;
    if (next >= text_.size() || std::isdigit(static_cast<unsigned char>(text_[next])) == 0) return;
    while (next < text_.size() && std::isdigit(static_cast<unsigned char>(text_[next])) != 0) ++next;
    end = next;
  }

  void take_text(char quote) {
    // Gmsh cuts longer ones off, and takes their rest for code.
    constexpr std::size_t longest = 1000;
    const std::size_t close = text_.find(quote, at_ + 1);
    if (close == std::string::npos || close - at_ > longest)
      refuse(path_, line_, fmt::format("found a text that does not end within {} characters", longest));
    add(Token::Kind::text, close + 1);
  }

  const std::string& text_;
  const std::string& path_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::vector<Token> tokens_;
};

/// Looks at one geometry and at those it includes.
class Examiner {
 public:
  explicit Examiner(const std::string& path)
      : folder_(fs::weakly_canonical(fs::absolute(path)).parent_path()) {}

  void examine(const std::string& path) {
    if (!seen_.insert(fs::weakly_canonical(path).string()).second) return;
    std::error_code ignored;
    if (fs::exists(path + ".opt", ignored))
      refuse(path, 0, fmt::format("found '{}.opt' beside it, which gmsh runs before it", path));
    const std::vector<Token> tokens = Lexer(read_text(path), path).tokens();
    for (std::size_t i = 0; i < tokens.size(); ++i)
      if (tokens[i].kind == Token::Kind::word) examine_word(tokens, i, path);
  }

 private:
  static bool is_sign(const std::vector<Token>& tokens, std::size_t i, char sign) {
    return i < tokens.size() && tokens[i].kind == Token::Kind::sign && tokens[i].value[0] == sign;
  }
  static bool is_word(const std::vector<Token>& tokens, std::size_t i) {
    return i < tokens.size() && tokens[i].kind == Token::Kind::word;
  }
  /// Position after a bracket that opens at i and all that is in it.
  static std::size_t after_bracket(const std::vector<Token>& tokens, std::size_t i) {
    int depth = 0;
    for (; i < tokens.size(); ++i) {
      if (tokens[i].kind != Token::Kind::sign) continue;
      const char c = tokens[i].value[0];
      if (c == '(' || c == '[' || c == '{') ++depth;
      if ((c == ')' || c == ']' || c == '}') && --depth <= 0) return i + 1;
    }
    return i;
  }

  void examine_word(const std::vector<Token>& tokens, std::size_t i, const std::string& path) {
    const std::string& word = tokens[i].value;
    const int line = tokens[i].line;
    if (refused.contains(word)) refuse(path, line, fmt::format("found '{}'", word));
    if (word == "Include" || word == "Merge") return examine_inclusion(tokens, i, path);
    if (word == "Printf" || word == "Warning" || word == "Error") {
      // After the brackets a file to write to may stand.
      if (!is_sign(tokens, i + 1, '(') || !is_sign(tokens, after_bracket(tokens, i + 1), ';'))
        refuse(path, line, fmt::format("found '{}' that writes to a file", word));
      return;
    }
    if ((word == "Macro" || word == "Function") && !is_word(tokens, i + 1))
      refuse(path, line, fmt::format("found '{}' without a word for its name", word));
    if (word == "General") {
      if (!is_sign(tokens, i + 1, '.') || !is_word(tokens, i + 2) ||
          !harmless_general.contains(tokens[i + 2].value))
        refuse(path, line, "found an option of the category 'General' that may open files or start programs");
      return;
    }
    if (word == "Field") examine_field(tokens, i, path);
    if (harmless.contains(word)) return;
    // A name of the geometry's own: what follows it is an operator, or a word that no command is followed by.
    if (i + 1 >= tokens.size() || tokens[i + 1].kind == Token::Kind::sign) return;
    if (is_word(tokens, i + 1) && (tokens[i + 1].value == "In" || tokens[i + 1].value == "Using")) return;
    if (i > 0 && (tokens[i - 1].value == "Macro" || tokens[i - 1].value == "Function")) return;
    refuse(path, line, fmt::format("found the command '{}', which is not known to be harmless", word));
  }

  static void examine_field(const std::vector<Token>& tokens, std::size_t i, const std::string& path) {
    if (!is_sign(tokens, i + 1, '[') && !is_sign(tokens, i + 1, '(')) return;
    const std::size_t end = after_bracket(tokens, i + 1);
    if (!is_sign(tokens, end, '=')) return;
    if (is_word(tokens, end + 1) && harmless_fields.contains(tokens[end + 1].value)) return;
    refuse(path, tokens[i].line,
           fmt::format("found a size field of the type '{}', which is not known to be harmless",
                       end + 1 < tokens.size() ? tokens[end + 1].value : ""));
  }

  void examine_inclusion(const std::vector<Token>& tokens, std::size_t i, const std::string& path) {
    const std::string& word = tokens[i].value;
    const int line = tokens[i].line;
    const bool is_literal =
        i + 2 < tokens.size() && tokens[i + 1].kind == Token::Kind::text && is_sign(tokens, i + 2, ';');
    if (!is_literal) refuse(path, line, fmt::format("found '{}' of a file whose name is computed", word));
    const std::string& quoted = tokens[i + 1].value;
    const std::string name = quoted.substr(1, quoted.size() - 2);
    const fs::path file = fs::path(path).parent_path() / name;
    std::error_code code;
    if (!is_below(file, folder_))
      refuse(path, line,
             fmt::format("found '{}' of '{}', which is not below the geometry's folder", word,
                         on_one_line(name)));
    const std::string ending = file.extension().string();
    if (ending == ".geo")
      examine(file.string());
    else if (word == "Include" || !harmless_endings.contains(ending) ||
             fs::exists(file.string() + ".opt", code))
      refuse(path, line,
             fmt::format(
                 "found '{}' of '{}'; expected a geometry (.geo) or, to merge, a file that ends in .step, "
                 ".brep, .iges or .stl, without options (.opt) beside it",
                 word, on_one_line(name)));
  }

  fs::path folder_;
  std::set<std::string> seen_;
};

}  // namespace

void require_harmless_geometry(const std::string& path) { Examiner(path).examine(path); }

}  // namespace seam
