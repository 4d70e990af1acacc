// SPDX-License-Identifier: BSD-3-Clause
// Scenes that come from strangers: each attack here did something once.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "run_command.hpp"

using Catch::Matchers::Contains;
using namespace seam_cli_test;
namespace fs = std::filesystem;

namespace {

/// A folder that is the current one while it lives.
struct Here : Folder {
  fs::path before = fs::current_path();
  Here() { fs::current_path(path); }
  ~Here() { fs::current_path(before); }
  Here(const Here&) = delete;
  Here& operator=(const Here&) = delete;
};

std::string with(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

const std::string block = R"yaml(title: A block
dimension: 2
plugins: [solid]
meshes: {box: {grid: {from: [0, 0], to: [1, 1], cells: [2, 2]}}}
fields:
  block:
    type: solid
    mesh: box
    material: {type: neo_hookean, young: 10, poisson: 0.3}
    boundary: [{on: y_min, displacement: [0, 0]}]
)yaml";

const std::string square =
    "Point(1) = {0, 0, 0, 1}; Point(2) = {1, 0, 0, 1}; Point(3) = {1, 1, 0, 1}; Point(4) = {0, 1, 0, 1};\n"
    "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1, 2, 3, 4};\n"
    "Plane Surface(1) = {1}; Physical Surface(\"all\") = {1}; Physical Curve(\"y_min\") = {1};\n";

std::string of_file(const std::string& file) {
  return with(block, "grid: {from: [0, 0], to: [1, 1], cells: [2, 2]}", "file: '" + file + "'");
}

void run_shell(const std::string& command) { REQUIRE(std::system(command.c_str()) == 0); }

}  // namespace

TEST_CASE("a geometry that does more than describe shapes is refused before gmsh is started") {
  struct Attack {
    std::string geometry;  ///< @ stands for the file that it makes, OUT for a folder beside the scene's
    std::string found;
    bool works = true;  ///< with gmsh 4.8, when it is let through
  };
  const std::string long_text(1023, 'x');
  const std::vector<Attack> attacks{
      {"SystemCall \"touch @\";", "'SystemCall'"},
      {"NonBlockingSystemCall \"touch @\"; Sleep 1;", "'NonBlockingSystemCall'"},
      {"If(1) SystemCall StrCat(\"touch \", \"@\"); EndIf", "'SystemCall'"},
      {"Printf(\"x\") > \"@\";", "'Printf' that writes to a file"},
      {"Printf(\"x\") >> StrCat(\"@\", \"\");", "'Printf' that writes to a file"},
      {"Save \"@\";", "'Save'", false},
      {"Print \"@\";", "'Print'", false},
      {"Merge \"OUT/evil.geo\";", "not below the geometry's folder"},
      {"Include \"OUT/evil.geo\";", "not below the geometry's folder"},
      {"Include StrCat(\"OUT/\", \"evil.geo\");", "name is computed"},
      {"Include \"inside.geo\";", "inside.geo:1: error: found 'SystemCall'"},
      {"Merge \"link.geo\";", "not below the geometry's folder"},
      {"Merge \"inside.txt\";", "expected a geometry (.geo)"},
      {"x = \"" + long_text + "; SystemCall 'touch @';\n//\";", "a text that does not end", false},
      {std::string("/* ") + '\0' + " */ SystemCall 'touch @'; /* */", "control character 0x00", false},
      {"Field[1] = ExternalProcess; Field[1].CommandLine = \"touch @\"; Background Field = 1;",
       "ExternalProcess"},
      {"OnelabRun(\"x\", \"touch @\");", "'OnelabRun'", false},
      {"General.ErrorFileName = \"@\";", "category 'General'", false},
      {"SetChanged;", "'SetChanged'", false},
      {"Unheard \"@\";", "the command 'Unheard'", false},
  };
  for (const Attack& attack : attacks) {
    const Here here;
    fs::create_directories("in");
    fs::create_directories("out");
    const std::string mark = (here.path / "mark").string(), out = (here.path / "out").string();
    const std::string evil = "SystemCall \"touch " + mark + "\";\n";
    static_cast<void>(here.file("out/evil.geo", evil));
    static_cast<void>(here.file("in/inside.geo", evil));
    static_cast<void>(here.file("in/inside.txt", evil));
    fs::create_symlink("../out/evil.geo", "in/link.geo");
    static_cast<void>(
        here.file("in/square.geo", square + with(with(attack.geometry, "@", mark), "OUT", out) + "\n"));
    static_cast<void>(here.file("in/scene.yaml", of_file("square.geo")));
    CAPTURE(attack.geometry);
    const Result result = seam("check in/scene.yaml");
    CHECK(result.code == 2);
    CHECK_THAT(result.output, Contains(attack.found));
    CHECK_FALSE(fs::exists(mark));
    if (!attack.works) continue;
    // Some go on for ever; all begin within a tenth of this.
    static_cast<void>(seam("check in/scene.yaml --trust-geometry --limit mesher_seconds=8"));
    CHECK(fs::exists(mark));
  }
}

TEST_CASE("options beside a geometry, which gmsh runs first, are refused") {
  const Here here;
  static_cast<void>(here.file("square.geo", square));
  static_cast<void>(here.file("scene.yaml", of_file("square.geo")));
  CHECK(seam("check scene.yaml").code == 0);
  static_cast<void>(here.file("square.geo.opt", "SystemCall \"touch mark\";\n"));
  const Result result = seam("check scene.yaml");
  CHECK(result.code == 2);
  CHECK_THAT(result.output, Contains("'square.geo.opt' beside it"));
  CHECK_FALSE(fs::exists("mark"));
  CHECK(seam("check scene.yaml --trust-geometry").code == 0);
  CHECK(fs::exists("mark"));
}

TEST_CASE("geometries of the shipped scenes are harmless, and those that include others below their folder") {
  // Long ones are meshed elsewhere: here gmsh is not even looked for.
  int count = 0;
  const Here here;
  for (const auto& entry : fs::recursive_directory_iterator(SEAM_SOURCE_DIR "/configs")) {
    if (entry.path().extension() != ".geo") continue;
    fs::copy_file(entry.path(), "shape.geo", fs::copy_options::overwrite_existing);
    static_cast<void>(here.file("scene.yaml", of_file("shape.geo")));
    const Result result = seam("check scene.yaml", "PATH=/nowhere");
    CAPTURE(entry.path());
    CHECK_THAT(result.output, Contains("gmsh cannot be started"));
    ++count;
  }
  CHECK(count > 10);
  fs::create_directories("parts");
  static_cast<void>(here.file("parts/square.geo", square));
  static_cast<void>(here.file("shape.geo", "Include \"parts/square.geo\";\nPrintf(\"%g\", 1 > 0);\n"));
  static_cast<void>(here.file("scene.yaml", of_file("shape.geo")));
  const Result result = seam("check scene.yaml");
  CHECK(result.code == 0);
}

TEST_CASE("gmsh is ended when it takes too long or seam is killed, and leaves nothing behind") {
  const Here here;
  static_cast<void>(here.file("endless.geo", "For i In {1:1e9}\n x = i;\nEndFor\n"));
  static_cast<void>(here.file("scene.yaml", of_file("endless.geo")));
  fs::create_directories("tmp");
  setenv("TMPDIR", (here.path / "tmp").c_str(), 1);
  const Result result = seam("check scene.yaml --limit mesher_seconds=1");
  CHECK(result.code == 2);
  CHECK_THAT(result.output,
             Contains("not meshed this geometry within 1 s") && Contains("--limit mesher_seconds"));
  static_cast<void>(here.file("fine.geo", with(square, ", 0, 1};", ", 0, 0.002};")));
  static_cast<void>(here.file("fine.yaml", of_file("fine.geo")));
  CHECK_THAT(seam("check fine.yaml --limit mesher_bytes=300000000").output,
             Contains("ended by a signal: its limits are --limit mesher_bytes"));

  const pid_t child = fork();
  if (child == 0) {
    execl(SEAM_COMMAND, SEAM_COMMAND, "check", (here.path / "scene.yaml").c_str(), nullptr);
    _exit(127);
  }
  const std::string mine = "pgrep -P " + std::to_string(child) + " gmsh >/dev/null";
  bool has_begun = false;
  for (int i = 0; i < 20000 && !has_begun; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    has_begun = std::system(mine.c_str()) == 0;
  }
  REQUIRE(has_begun);
  FILE* pipe = popen(("pgrep -P " + std::to_string(child) + " gmsh").c_str(), "r");
  int gmsh = 0;
  REQUIRE(fscanf(pipe, "%d", &gmsh) == 1);
  pclose(pipe);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  bool lives = true;
  for (int i = 0; i < 10000 && lives; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    // One that has ended, but whose new parent has not noticed, is no process any more.
    const std::string state = "grep -q '^State:.[^Z]' /proc/" + std::to_string(gmsh) + "/status 2>/dev/null";
    lives = std::system(state.c_str()) == 0;
  }
  CHECK_FALSE(lives);
  unsetenv("TMPDIR");
  for (const auto& entry : fs::directory_iterator("tmp"))
    CHECK_THAT(entry.path().filename().string(), !Contains("seam"));
}

TEST_CASE("what gmsh prints cannot be taken for messages of seam") {
  const Here here;
  static_cast<void>(here.file("bad.geo", "Error(\"::error::forged\");\nSyntax error here;\n"));
  static_cast<void>(here.file("scene.yaml", of_file("bad.geo")));
  CHECK_THAT(seam("check scene.yaml").output, Contains("not known to be harmless"));
  static_cast<void>(here.file("bad.geo", "Error(\"x\n::error::forged\");\n"));
  const Result result = seam("check scene.yaml");
  CHECK(result.code == 2);
  CHECK_THAT(result.output, Contains("forged") && !Contains("\n::error"));
}

TEST_CASE("under --restricted a scene opens nothing but what lies beside it") {
  struct Refused {
    std::string from, to;  ///< what makes the scene one that is refused
    std::string found;
    bool is_fine_else = true;  ///< without --restricted
  };
  const std::string mesh = "grid: {from: [0, 0], to: [1, 1], cells: [2, 2]}";
  const std::string times = "time: {end: 1, step: {initial: 1, replay: ";
  const std::vector<Refused> refused{
      {mesh, "file: ../out/square.msh", "outside the scene's folder"},
      {mesh, "file: link.msh", "outside the scene's folder"},
      {mesh, "file: ABSOLUTE/out/square.msh", "outside the scene's folder"},
      {mesh, "file: linked/square.msh", "outside the scene's folder"},
      {mesh, "file: square.geo", "--restricted allows none"},
      {"fields:", times + "../out/series.csv}}\nfields:", "outside the scene's folder"},
      {"plugins:", "plugin_folders: [.]\nplugins:", "plugin_folders: plugins are code"},
      {"fields:", "output: {folder: ../elsewhere}\nfields:", "expected a relative path"},
      {"fields:", "output: {folder: ABSOLUTE/elsewhere}\nfields:", "expected a relative path"},
      {"fields:", "output: {folder: a/../../elsewhere}\nfields:", "expected a relative path"},
      {"[2, 2]", "[2000, 2000]", "found 4000000 cells in the grid, at most 1e+06", false},
  };
  const Here here;
  fs::create_directories("in");
  fs::create_directories("out");
  static_cast<void>(here.file("in/square.geo", square));
  run_shell("gmsh -v 0 -2 in/square.geo -o out/square.msh >/dev/null && cp out/square.msh in");
  static_cast<void>(here.file("out/series.csv", "time\n0\n0.5\n1\n"));
  fs::create_symlink("../out/square.msh", "in/link.msh");
  fs::create_directory_symlink("../out", "in/linked");
  static_cast<void>(here.file("in/sound.yaml", of_file("square.msh")));
  for (const std::string words : {"check in/sound.yaml --restricted", "--restricted check in/sound.yaml"}) {
    const Result result = seam(words);
    CHECK(result.code == 0);
    CHECK_THAT(result.output, !Contains("warning"));
  }
  for (const Refused& one : refused) {
    CAPTURE(one.to);
    REQUIRE_THAT(block, Contains(one.from));
    static_cast<void>(
        here.file("in/scene.yaml", with(with(block, one.from, one.to), "ABSOLUTE", here.path.string())));
    const Result result = seam("run in/scene.yaml --quiet --restricted");
    CHECK(result.code == 2);
    CHECK_THAT(result.output, Contains("in/scene.yaml:") && Contains(one.found));
    CHECK_FALSE(fs::exists("results/scene/series.csv"));
    CHECK_FALSE(fs::exists(here.path / "elsewhere"));
    if (!one.is_fine_else) continue;
    const Result open = seam("check in/scene.yaml");
    CHECK(open.code == 0);
    // What lies elsewhere is named, at least.
    if (one.found == "outside the scene's folder")
      CHECK_THAT(open.output, Contains("warning:") && Contains(one.found));
  }
}

TEST_CASE("--restricted holds for plugins, results and studies, too") {
  const Here here;
  fs::create_directories("in");
  static_cast<void>(here.file("in/scene.yaml", block));
  SECTION("folders with plugins that the environment names are not searched") {
    CHECK_THAT(seam("explain").output, Contains("(beam)"));
    CHECK_THAT(seam("explain --restricted").output, !Contains("(beam)") && Contains("(solid)"));
  }
  SECTION("results do not leave the current folder by a link") {
    fs::create_directory_symlink("/tmp", "results");
    static_cast<void>(here.file("in/scene.yaml", block));
    const Result result = seam("run in/scene.yaml --quiet --restricted");
    CHECK(result.code == 2);
    CHECK_THAT(result.output, Contains("outside the current folder"));
    CHECK(seam("run in/scene.yaml --quiet --restricted --folder here").code == 0);
  }
  SECTION("a study restricts its runs") {
    static_cast<void>(
        here.file("in/scene.yaml", "parameters: {n: 1}\n" + with(block, "[2, 2]", "[n, 2]") +
                                       "study: {vary: {n: [1, 1000000]}, measure: unknowns}\n"));
    const Result result = seam("study in/scene.yaml --restricted");
    CHECK(result.code == 1);
    CHECK_THAT(result.output, Contains("found 2000000 cells"));
  }
  SECTION("flags that contradict each other are not guessed at") {
    CHECK(seam("check in/scene.yaml --restricted --trust-geometry").code == 2);
    CHECK_THAT(seam("check in/scene.yaml --limit cell=3").output, Contains("expected one of cells"));
    CHECK_THAT(seam("check in/scene.yaml --limit cells=x").output, Contains("expected NAME=NUMBER"));
  }
}

TEST_CASE("a scene that asks for more than is allowed is refused where it asks, before any memory is taken") {
  struct Large {
    std::string scene, found, options;
  };
  const std::string disc =
      "interfaces: {disc: {type: cut, field: block, body: {type: circle, centre: [0.5, 0.5], radius: 0.2, "
      "facets: 1000000}}}\n";
  const std::vector<Large> scenes{
      {with(block, "[2, 2]", "[20000, 20000]"), "found 400000000 cells in the grid, at most 1e+08", ""},
      {with(block, "[2, 2]", "[100000000, 100000000]"), "found 1e+16 cells in the grid", ""},
      {with(block, "from: [0, 0], to: [1, 1], cells: [2, 2]",
            "segments: {from: [0, 0], x: [{to: 1, cells: 2000000000}], y: [{to: 1, cells: 1}]}"),
       "found 2000000000 cells", ""},
      {block, "found 18 unknowns of the field", "--limit unknowns=17"},
      {block, "found 4 cells", "--limit cells=3"},
      {with(block, "young: 10", "young: \"" + std::string(201, '(') + "1" + std::string(201, ')') + "\""),
       "more than 200 brackets", ""},
      {with(block, "young: 10", "young: \"1" + std::string(4000, ' ') + "\""), "at most 4000", ""},
      {block + "time: {end: 1, step: {initial: 1, replay: scene.yaml}}\n", "bytes in the file 'scene.yaml'",
       "--limit file_bytes=99"},
  };
  const Here here;
  for (const Large& one : scenes) {
    static_cast<void>(here.file("scene.yaml", one.scene));
#if defined(__SANITIZE_ADDRESS__)  // which reserves terabytes
    const std::string within;
#else  // 2 GB would do for all that is below the limits.
    const std::string within = "sh -c 'ulimit -v 2000000; exec \"$@\"' sh";
#endif
    const Result result = seam("check " + one.options + " scene.yaml", within);
    CHECK(result.code == 2);
    CHECK_THAT(result.output, Contains("scene.yaml:") && Contains(one.found));
  }
  SECTION("nor does one that takes too long, or whose name would be a line of the log") {
    static_cast<void>(
        here.file("slow.yaml",
                  block + "time: {static: true, end: 1, step: {initial: 1e-6}}\noutput: {fields: false}\n"));
    static_cast<void>(here.file("good.yaml", block));
    static_cast<void>(here.file("x\n7 passed, 0 failed\n.yaml", block));
    const Result result =
        seam("verify --restricted --limit seconds=3 slow.yaml *passed*.yaml good.yaml --quiet");
    INFO(result.output);
    CHECK(result.code == 1);
    CHECK_THAT(result.output, Contains("FAIL slow.yaml") && Contains("ok   good.yaml") &&
                                  Contains("1 passed, 2 failed") && !Contains("\n7 passed"));
  }
  SECTION("and does not end `seam verify` of the others") {
    static_cast<void>(here.file("huge.yaml", with(block, "[2, 2]", "[20000, 20000]")));
    static_cast<void>(here.file("good.yaml", block));
    const Result result = seam("verify huge.yaml absent.yaml good.yaml --quiet");
    CHECK(result.code == 1);
    CHECK_THAT(result.output, Contains("FAIL huge.yaml") && Contains("FAIL absent.yaml") &&
                                  Contains("ok   good.yaml") && Contains("1 passed, 2 failed"));
  }
}

TEST_CASE("thousands of parameters, each of those before it, are read at once") {
  std::string chained = "parameters:\n  p0: 1\n", lone = chained;
  for (int i = 1; i < 3000; ++i) {
    const std::string name = "  p" + std::to_string(i) + ": ";
    chained += name + "p" + std::to_string(i - 1) + " + 1\n";
    lone += name + "1 + 1\n";
  }
  const Here here;
  static_cast<void>(here.file("chained.yaml", chained + with(block, "young: 10", "young: p2999")));
  static_cast<void>(here.file("lone.yaml", lone + with(block, "young: 10", "young: p2999")));
  const auto processor_seconds = [](const std::string& scene) {
    const auto so_far = [] {
      rusage used{};
      getrusage(RUSAGE_CHILDREN, &used);
      return static_cast<double>(used.ru_utime.tv_sec) + 1e-6 * static_cast<double>(used.ru_utime.tv_usec);
    };
    const double before = so_far();
    CHECK(seam("check " + scene).code == 0);
    return so_far() - before;
  };
  // It was half a minute, a hundred times as long.
  CHECK(processor_seconds("chained.yaml") < 10 * processor_seconds("lone.yaml"));
}

TEST_CASE("what a scene says of itself forges no lines of a log") {
  const Here here;
  const std::string checks =
      "output: {probes: {u: {field: block, at: [0, 0], quantity: displacement, component: x}}}\n";
  const std::string source = "\"x\\n::error::forged\\n  ok    all\"";
  static_cast<void>(here.file("scene.yaml", with(block, "A block", source) + checks +
                                                "checks: [{that: u, at_most: 1, source: " + source + "}]\n"));
  const Result result = seam("run scene.yaml --quiet");
  CHECK(result.code == 0);
  CHECK_THAT(result.output, Contains("forged") && !Contains("\n::error") && !Contains("\n  ok    all"));
  static_cast<void>(here.file("scene.yaml", with(block, "A block", "'::error::forged'")));
  CHECK_THAT(seam("run scene.yaml --quiet").output, Contains("forged") && !Contains("::error"));
  for (const std::string escape : {"\\e[31m", "\\u009b31m", "\\u202e", "\\u2028", "\\0"}) {
    static_cast<void>(here.file("scene.yaml", with(block, "A block", "\"red " + escape + "\"")));
    const Result refused = seam("check scene.yaml");
    CAPTURE(escape);
    CHECK(refused.code == 2);
    CHECK_THAT(refused.output, Contains("scene.yaml:1:8: error: found a control character"));
  }
  static_cast<void>(here.file("::error::x.yaml", block));
  CHECK_THAT(seam("check ::error::x.yaml").output, !Contains("\n::error") && Contains("rename it"));
}

TEST_CASE("files that a run writes replace links, and do not follow them") {
  const Here here;
  static_cast<void>(here.file("scene.yaml", block));
  static_cast<void>(here.file("precious", "untouched"));
  for (const std::string name : {"series.csv.part", "summary.json.tmp", "series.csv.tmp", "run.json.tmp"}) {
    fs::remove_all("out");
    fs::create_directories("out");
    fs::create_symlink("../precious", "out/" + name);
    CAPTURE(name);
    CHECK(seam("run scene.yaml --quiet --overwrite --folder out").code == 0);
    CHECK(here.read("precious") == "untouched");
  }
}

TEST_CASE("git runs no program that a scene's folder names") {
  const Here here;
  const std::string study = "parameters: {n: 1}\n" + with(block, "[2, 2]", "[n, 2]") +
                            "study: {vary: {n: [1, 2]}, measure: unknowns}\n";
  static_cast<void>(here.file("scene.yaml", study));
  const std::string git = "git -c user.name=a -c user.email=a@b ";
  run_shell(git + "init -q . && " + git + "add scene.yaml && " + git + "commit -qm one");
  static_cast<void>(here.file("evil.sh", "#!/bin/sh\ntouch '" + (here.path / "mark").string() + "'\ncat\n"));
  run_shell("chmod +x evil.sh && mkdir hooks && cp evil.sh hooks/post-index-change");
  const auto commit = [&] {
    const Result result = seam("study scene.yaml --overwrite");
    CHECK(result.code == 0);
    const std::string table = here.read("results/scene-study/study.csv");
    const std::size_t at = table.find("# commit: ") + 10;
    return table.substr(at, table.find('\n', at) - at);
  };
  CHECK(commit().size() == 12);
  static_cast<void>(here.file("scene.yaml", study + "\n"));
  CHECK_THAT(commit(), Contains(" with changes"));
  run_shell(git + "commit -qam two");
  const std::string evil = (here.path / "evil.sh").string();
  static_cast<void>(here.file(".gitattributes", "*.yaml filter=x\n"));
  using Attack = std::pair<std::string, std::string>;
  for (const auto& [key, value] :
       {Attack{"core.fsmonitor", evil}, Attack{"core.hooksPath", "hooks"}, Attack{"filter.x.clean", evil}}) {
    CAPTURE(key);
    run_shell("git config " + key + " '" + value + "'");
    // The attack is a real one.
    run_shell("touch scene.yaml; git status >/dev/null 2>&1");
    CHECK(fs::exists("mark"));
    fs::remove("mark");
    run_shell("touch scene.yaml");
    const std::string found = commit();
    CHECK_FALSE(fs::exists("mark"));
    if (key == "filter.x.clean")
      CHECK_THAT(found, Contains("the repository runs filters"));
    else
      CHECK(found.size() == 12);
    run_shell("git config --unset " + key);
  }
  if (geteuid() != 0) return;
  run_shell("chown -R 4711 .");
  CHECK(commit() == "unknown");
}

TEST_CASE("plugins come from where only their owner, root or Seam's owner may write") {
  const Here here;
  const fs::path library = fs::path(SEAM_TEST_PLUGINS) / "libseam_beam.so";
  REQUIRE(fs::exists(library));
  const auto plugins = [&](const std::string& folder) {
    return seam("plugins", "SEAM_PLUGIN_PATH=" + (here.path / folder).string()).output;
  };
  const auto make = [&](const std::string& folder) {
    fs::create_directories(folder);
    fs::copy_file(library, folder + "/libseam_beam.so", fs::copy_options::overwrite_existing);
  };
  make("sound/plugins");
  CHECK_THAT(plugins("sound/plugins"),
             Contains("provides: field beam") && !Contains("unusable: found a file"));
  make("open/plugins");
  fs::permissions("open", fs::perms::others_write, fs::perm_options::add);
  CHECK_THAT(plugins("open/plugins"),
             !Contains("field beam") && Contains("open' above it: everybody may write"));
  SECTION("a link counts with the folder that it stands in") {
    fs::create_directory_symlink("../sound/plugins", "open/link");
    CHECK_THAT(plugins("open/link"), !Contains("field beam") && Contains("everybody may write to it"));
    fs::create_directory_symlink("open/plugins", "link");
    CHECK_THAT(plugins("link"), !Contains("field beam"));
    fs::remove("sound/plugins/libseam_beam.so");
    fs::create_symlink(here.path / "open/plugins/libseam_beam.so", "sound/plugins/libseam_beam.so");
    CHECK_THAT(plugins("sound/plugins"), Contains("unusable: found a file that others may change"));
  }
  SECTION("a sticky folder above is fine, as /tmp is") {
    fs::permissions("open", fs::perms::sticky_bit, fs::perm_options::add);
    CHECK_THAT(plugins("open/plugins"), Contains("provides: field beam"));
  }
  SECTION("a group of users may not write, either") {
    if (geteuid() != 0) return;  // only root gives files away
    make("shared/plugins");
    run_shell("chgrp 4711 shared && chmod g+w shared");
    CHECK_THAT(plugins("shared/plugins"),
               !Contains("field beam") && Contains("a group of users (number 4711) may write to it"));
  }
  SECTION("what belongs to somebody else is refused, with what to do") {
    if (geteuid() != 0) return;
    run_shell("chown 4711 sound/plugins/libseam_beam.so");
    CHECK_THAT(plugins("sound/plugins"), Contains("belongs to another user (number 4711)") &&
                                             Contains("copy it to a folder of your own"));
    run_shell("chown 4711 sound");
    CHECK_THAT(plugins("sound/plugins"), Contains("sound' above it: it belongs to another user"));
    run_shell("chown 4711 open/plugins && chmod +t open");
    CHECK_THAT(plugins("open/plugins"), !Contains("field beam"));
  }
  SECTION("the hint of a plugin that is not found names the folder that is not searched") {
    static_cast<void>(here.file("scene.yaml", with(block, "[solid]", "[solid, beam]")));
    const Result result =
        seam("check scene.yaml", "SEAM_PLUGIN_PATH=" + (here.path / "open/plugins").string());
    CHECK(result.code == 3);
    CHECK_THAT(result.output, Contains("not searched: ") && Contains("do as is said there"));
  }
}

TEST_CASE("no title begins a command of continuous integration behind spaces of any width") {
  const Here here;
  for (const std::string blank : {"\\u00a0", "\\u2003", "\\u3000", "\\u180e", "\\u00a0 \\u2009"}) {
    static_cast<void>(here.file(
        "scene.yaml", with(block, "title: A block", "title: \"" + blank + "::error file=x.yaml::pwned\"")));
    const Result result = seam("run scene.yaml --quiet --no-picture --overwrite");
    INFO(result.output);
    CHECK(result.code == 0);
    CHECK_THAT(result.output, Contains(": :error") && !Contains("::error"));
  }
  for (const std::string mark : {"\\u200b", "\\u200f", "\\u061c", "\\ufeff"}) {
    static_cast<void>(here.file("scene.yaml", with(block, "title: A block", "title: \"a" + mark + "b\"")));
    CHECK_THAT(seam("check scene.yaml").output, Contains("found a control character"));
  }
}

TEST_CASE("results are no folder in the place of a file of another run") {
  const Here here;
  static_cast<void>(here.file("scene.yaml", block + "output: {folder: results/a/run.lock}\n"));
  const Result result = seam("run scene.yaml --quiet --no-picture");
  CHECK(result.code == 2);
  CHECK_THAT(result.output, Contains("'run.lock' is called like a file that runs write"));
}
