// SPDX-License-Identifier: BSD-3-Clause
// seam verify --matrix: what comes of variants that pass, fall short, die, hang or are refused.
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "process.hpp"

using Catch::Matchers::Contains;
using namespace seam_cli_test;

namespace {

/// Runs all variants of scene.yaml into the folder `matrix`.
Result verify(const Folder& folder, const std::string& options = "") {
  return seam("verify --matrix " + (folder.path / "scene.yaml").string() + " --folder " +
              (folder.path / "matrix").string() + " " + options);
}

nlohmann::json table(const Folder& folder) {
  return nlohmann::json::parse(folder.read("matrix/matrix.json"));
}

/// "ok", "known" or "FAIL", by variant.
std::map<std::string, std::string> verdicts(const Folder& folder) {
  const nlohmann::json written = table(folder);
  std::map<std::string, std::string> all;
  for (const nlohmann::json& variant : written.at("variants"))
    all[variant.at("variant").get<std::string>()] = variant.at("verdict").get<std::string>();
  return all;
}

/// What a variant says of one thing.
nlohmann::json finding(const Folder& folder, const std::string& variant, const std::string& what) {
  const nlohmann::json written = table(folder);
  for (const nlohmann::json& v : written.at("variants"))
    for (const nlohmann::json& f : v.at("findings"))
      if (v.at("variant") == variant && f.at("what") == what) return f;
  FAIL("no finding '" << what << "' of '" << variant << "'");
  return {};
}

/// The block pulled by a load that something happens to at t = 0.45, as its key `what` says.
std::string troubled(const std::string& matrix) {
  return pulled_by("{type: trouble, at: 2, load: 1, what: exception, rank: \"0\"}", "trouble") + "matrix:\n" +
         matrix;
}

std::string slow(const std::string& matrix) {
  return pulled_by("{type: slow, seconds: 0, load: 1}", "slow") + "matrix:\n" + matrix;
}

}  // namespace

TEST_CASE("what cannot be read or set up is a row like any other") {
  const Folder folder;
  // A value with which no variant can be read is a mistake of the block: then the scene is the row.
  (void)folder.file("scene.yaml",
                    troubled("  vary: {meshes.block.grid.cells: [\"[2, 2]\", \"[2, 2, 2]\"]}\n"));
  CHECK(verify(folder).code == 1);
  CHECK_THAT(finding(folder, "", "the run").at("message").get<std::string>(),
             Contains("the scene cannot be read with '[2, 2, 2]'") && Contains("scene.yaml:18"));
  // What only shows when the scene is set up is the variant's.
  (void)folder.file("scene.yaml", troubled("  vary: {output.probes.tip.at: [\"[1, 0.5]\", \"[3, 0.5]\"]}\n"));
  const Result result = verify(folder);
  INFO(result.output);
  CHECK(result.code == 1);
  CHECK_THAT(result.output, Contains("2 variants: 1 ok, 0 known to fall short, 1 failed"));
  CHECK(finding(folder, "output.probes.tip.at=[3, 0.5]", "the run").at("broken") == true);
}

TEST_CASE("variants that die or whose plugin fails and those whose checks do not hold") {
  const Folder folder;
  (void)folder.file("scene.yaml",
                    troubled("  vary:\n    functions.trouble.what: [death, exception]\n"
                             "    functions.trouble.at: [2, 0.45]\n    functions.trouble.load: [1, -1]\n"
                             "  leave_out: functions.trouble.at < 1 && functions.trouble.load < 0\n"));
  const Result result = verify(folder);
  INFO(result.output);
  CHECK(result.code == 1);
  const std::string dies = "functions.trouble.what=death functions.trouble.at=0.45 functions.trouble.load=1";
  const std::string throws =
      "functions.trouble.what=exception functions.trouble.at=0.45 functions.trouble.load=1";
  const std::string falls_short =
      "functions.trouble.what=exception functions.trouble.at=2 functions.trouble.load=-1";
  const std::string passes =
      "functions.trouble.what=exception functions.trouble.at=2 functions.trouble.load=1";
  auto all = verdicts(folder);
  CHECK(all.size() == 6);
  CHECK(all[dies] == "FAIL");
  CHECK(all[throws] == "FAIL");
  CHECK(all[falls_short] == "FAIL");
  CHECK(all[passes] == "ok");
  CHECK_THAT(finding(folder, dies, "the run").at("message").get<std::string>(),
             Contains("signal 9 (Killed)"));
  CHECK(finding(folder, dies, "the run").at("broken") == true);
  CHECK_THAT(finding(folder, throws, "the run").at("message").get<std::string>(),
             Contains("the library below is out of sorts"));
  CHECK(finding(folder, falls_short, "the run").at("holds") == true);
  CHECK(finding(folder, falls_short, "tip.x").at("holds") == false);
  CHECK(finding(folder, falls_short, "tip.x").at("broken") == false);
  CHECK_THAT(result.output, Contains("6 variants: 2 ok, 0 known to fall short, 4 failed"));

  // What failed is run again, and nothing else; the table keeps the others.
  const Result again = verify(folder, "--failed");
  CHECK_THAT(again.output, Contains("4 variants: 0 ok, 0 known to fall short, 4 failed"));
  CHECK(verdicts(folder) == all);
  // The command that is told for a variant does the same alone.
  const nlohmann::json written = table(folder);
  for (const nlohmann::json& v : written.at("variants")) {
    const std::string command = v.at("command");
    REQUIRE(command.starts_with("seam run "));
    const Result alone = seam(command.substr(5) + " --quiet");
    CHECK((alone.code == 0) == (v.at("verdict") == "ok"));
  }
}

TEST_CASE("a variant that is known to fall short is counted apart, and an error once it passes") {
  const std::string keys =
      "  vary:\n    functions.trouble.load: [1, -1]\n    ranks: [1, 2]\n"
      "  agree: [{over: [ranks], within: 1e-9}]\n  known:\n    - {when: functions.trouble.load < 0, reason: "
      "it is pushed}\n";
  const Folder folder;
  (void)folder.file("scene.yaml", troubled(keys));
  const Result result = verify(folder);
  INFO(result.output);
  CHECK(result.code == 0);
  CHECK_THAT(result.output,
             Contains("4 variants: 2 ok, 2 known to fall short, 0 failed") && Contains("it is pushed"));
  (void)folder.file(
      "scene.yaml",
      troubled(keys + "    - {when: functions.trouble.load > 0 && ranks == 2, reason: two do not pull}\n"));
  const Result passes = verify(folder);
  INFO(passes.output);
  CHECK(passes.code == 1);
  CHECK_THAT(passes.output, Contains("it passes, though it is declared to fall short (two do not pull)"));
  CHECK(verdicts(folder)["functions.trouble.load=1 ranks=2"] == "FAIL");
}

TEST_CASE("a variant that takes longer than it may is ended, with all that it started") {
  const Folder folder;
  const std::string begun = (folder.path / "begun").string();
  (void)folder.file("scene.yaml", slow("  vary:\n    functions.slow.from: [2, 0.45]\n    ranks: [1, 2]\n"));
  const Result result =
      verify(folder, "--time-limit 8s --set functions.slow.seconds=150 --set functions.slow.begun=" + begun);
  INFO(result.output);
  CHECK(result.code == 1);
  auto all = verdicts(folder);
  CHECK(all["functions.slow.from=2 ranks=1"] == "ok");
  CHECK(all["functions.slow.from=2 ranks=2"] == "ok");
  const nlohmann::json written = table(folder);
  // None ends when it is asked to, its step takes 150 s: on one rank it is killed, and mpirun kills two.
  for (const std::string hangs : {"functions.slow.from=0.45 ranks=1", "functions.slow.from=0.45 ranks=2"}) {
    CHECK(all[hangs] == "FAIL");
    CHECK_THAT(finding(folder, hangs, "the run").at("message").get<std::string>(),
               Contains("it took longer than the 8 s that it may"));
    for (const nlohmann::json& variant : written.at("variants"))
      if (variant.at("variant") == hangs) CHECK(variant.at("seconds").get<double>() < 100);
  }
  CHECK(std::filesystem::exists(begun));
  // Nothing of it is left.
  CHECK(std::system(
            ("pgrep -f '[s]eam run " + (folder.path / "scene.yaml").string() + "' >/dev/null").c_str()) != 0);
}

TEST_CASE("a signal ends a matrix and all that it started") {
  const Folder folder;
  const std::string begun = (folder.path / "begun").string();
  (void)folder.file("scene.yaml",
                    slow("  vary:\n    functions.slow.from: [0.46, 0.45]\n    ranks: [1, 2]\n"));
  Process process(
      "verify --matrix " + (folder.path / "scene.yaml").string() + " --folder " +
          (folder.path / "matrix").string() +
          " --jobs 1 --filter ranks=1 --set functions.slow.seconds=600 --set functions.slow.begun=" + begun,
      "", (folder.path / "log").string());
  process.wait_for([&] { return std::filesystem::exists(begun); });
  process.send(SIGTERM);
  CHECK(process.wait() == 128 + SIGTERM);
  CHECK_THAT(process.output(), Contains("interrupted by SIGTERM"));
  CHECK(std::system(
            ("pgrep -f '[s]eam run " + (folder.path / "scene.yaml").string() + "' >/dev/null").c_str()) != 0);
  CHECK(table(folder).at("failed") == 0);
  CHECK(table(folder).at("not_run") == 2);
  // What was not run has not passed.
  CHECK_THAT(verify(folder, "--failed --set functions.slow.seconds=0").output, Contains("2 variants: 2 ok"));
  CHECK(table(folder).at("not_run") == 0);
}

TEST_CASE("variants that must agree are compared, restarted ones too") {
  const Folder folder;
  const auto scene = [](const std::string& within) {
    return slow(
        "  vary:\n    ranks: [1, 2]\n    restart: [none, 1, 2]\n    time.step.initial: [0.1, 0.05]\n"
        "  agree:\n    - {over: [ranks, restart], within: 1e-9}\n"
        "    - {over: [time.step.initial], series: [tip.x], within: " +
        within + "}\n");
  };
  (void)folder.file("scene.yaml", scene("1"));
  const Result result = verify(folder, "--filter initial=0.1");
  INFO(result.output);
  CHECK(result.code == 0);
  CHECK_THAT(result.output, Contains("6 variants: 6 ok"));
  // What goes on from a restart point on one rank is the same to the bit.
  const std::string agreement = "agreement over ranks, restart";
  CHECK_THAT(
      finding(folder, "ranks=1 restart=1 time.step.initial=0.1", agreement).at("message").get<std::string>(),
      Contains("the same to the bit as 'ranks=1 restart=none time.step.initial=0.1'"));
  // As many jobs as one likes: the same, but for the time it takes.
  const auto without_seconds = [&] {
    const std::string page = folder.read("matrix/matrix.md");
    return std::regex_replace(page.substr(page.find(" variants: ")), std::regex(R"(\| [0-9.]+ \| [0-9]+ \|)"),
                              "");
  };
  const std::string on_all = without_seconds();
  REQUIRE(verify(folder, "--filter initial=0.1 --jobs 1").code == 0);
  CHECK(without_seconds() == on_all);
  // Other steps make other rows.
  const Result steps = verify(folder, "--filter 'restart=none'");
  INFO(steps.output);
  CHECK(steps.code == 1);
  CHECK_THAT(steps.output,
             Contains("tip.x has 21 rows, 11 with 'ranks=1 restart=none time.step.initial=0.1'"));
}

TEST_CASE("a run that failed before its middle does not go on") {
  const Folder folder;
  (void)folder.file("scene.yaml", troubled("  vary: {restart: [1], functions.trouble.at: [0.45]}\n"));
  CHECK(verify(folder).code == 1);
  const nlohmann::json only = table(folder).at("variants").at(0);
  CHECK(only.at("verdict") == "FAIL");
  const std::filesystem::path log = only.at("log").get<std::string>();
  CHECK(log.filename() == "log.txt");
  CHECK(!exists(log.parent_path() / "log-resumed.txt"));
}

TEST_CASE("a run that no step ends in its middle is no restart") {
  const Folder folder;
  // The second step, of more than half of the time, comes to the end.
  (void)folder.file(
      "scene.yaml",
      slow("  vary: {restart: [none, 1], ranks: [1, 2]}\n  leave_out: restart == none && ranks == 1\n"));
  const std::string steps =
      " --set 'time.step={initial: 0.49, maximum: 1, adaptive: true, tolerance: 1}' --set "
      "fields.block.density=1e-6";
  const Result result = verify(folder, steps);
  INFO(result.output);
  CHECK(result.code == 1);
  for (const std::string ranks : {"1", "2"})
    CHECK_THAT(finding(folder, "restart=1 ranks=" + ranks, "the run").at("message").get<std::string>(),
               Contains("no step ends in its middle"));
  // The first part has the ranks of the variant, the second one those of the restart.
  CHECK_THAT(result.output, Contains("mpirun --oversubscribe -np 2 seam run") &&
                                Contains("003-alone --overwrite && seam run"));
}

TEST_CASE("what the matrix must not touch it leaves alone, and what is missing it says") {
  const Folder folder;
  (void)folder.file("scene.yaml", slow("  vary:\n    ranks: [1]\n"));
  std::filesystem::create_directories(folder.path / "matrix");
  (void)folder.file("matrix/own.txt", "mine");
  CHECK_THAT(verify(folder).output, Contains("the folder holds what `seam verify --matrix` did not write"));
  CHECK(folder.read("matrix/own.txt") == "mine");
  std::filesystem::remove_all(folder.path / "matrix");
  CHECK_THAT(verify(folder, "--failed").output, Contains("there is no table of an earlier run"));
  CHECK_THAT(verify(folder, "--filter nothing").output, Contains("no variant is such"));
  // A shard may be empty, and is no mistake.
  CHECK(verify(folder, "--shard 5/5").code == 0);
  // Links are not followed.
  std::filesystem::create_directories(folder.path / "precious/001");
  (void)folder.file("precious/001/q", "mine");
  std::filesystem::create_directory_symlink(folder.path / "precious", folder.path / "matrix/001-scene");
  CHECK_THAT(verify(folder).output, Contains("a link stands where the matrix has a folder of its own"));
  CHECK(folder.read("precious/001/q") == "mine");
  std::filesystem::create_directories(folder.path / "empty");
  CHECK_THAT(seam("verify --matrix " + (folder.path / "empty").string()).output,
             Contains("the folder holds no scenes"));
  CHECK_THAT(seam("verify " + (folder.path / "scene.yaml").string() + " --jobs 1").output,
             Contains("--matrix"));
}

TEST_CASE("what failed last time is found again, however the scene is named, with what it must agree with") {
  const Folder folder;
  // Two variants that pass, and do not agree; one that fails.
  const std::string scene = troubled(
      "  vary: {functions.trouble.load: [1, 2, -1]}\n  known: [{when: functions.trouble.load < -5, reason: "
      "none}]\n"
      "  agree: [{over: [functions.trouble.load], series: [tip], within: 1e-3}]\n");
  const std::string text = scene.substr(0, scene.find("  known:")) + scene.substr(scene.find("  agree:"));
  (void)folder.file("scene.yaml", text);
  REQUIRE(verify(folder).code == 1);
  auto before = verdicts(folder);
  CHECK(before["functions.trouble.load=1"] == "ok");
  CHECK(before["functions.trouble.load=2"] == "FAIL");
  const std::string spelled = "verify --matrix " + (folder.path / "precious/../scene.yaml").string() +
                              " --folder " + (folder.path / "matrix").string() + " --failed";
  std::filesystem::create_directories(folder.path / "precious");
  const Result again = seam(spelled);
  INFO(again.output);
  CHECK(again.code == 1);
  CHECK_THAT(again.output, Contains("3 variants: 1 ok, 0 known to fall short, 2 failed"));
  // A part of all does not make the rest forgotten.
  CHECK(verify(folder, "--filter load=1").code == 0);
  CHECK(verify(folder, "--failed").code == 1);
  // A variant that is gone cannot be run again.
  std::string other = text;
  other.replace(other.find("[1, 2, -1]"), 10, "[1, 3, -1]");
  (void)folder.file("scene.yaml", other);
  const Result gone = verify(folder, "--failed");
  CHECK(gone.code == 2);
  CHECK_THAT(
      gone.output,
      Contains("'functions.trouble.load=2' failed last time, and the scene has no such variant any more"));
}

TEST_CASE("two matrices do not share a folder, and coverage that is asked for is a row") {
  const Folder folder;
  const std::string begun = (folder.path / "begun").string();
  (void)folder.file("scene.yaml", slow("  vary: {ranks: [1]}\n"));
  {
    Process process("verify --matrix " + (folder.path / "scene.yaml").string() + " --folder " +
                        (folder.path / "matrix").string() +
                        " --set functions.slow.from=0.45 --set functions.slow.seconds=600 --set "
                        "functions.slow.begun=" +
                        begun,
                    "", (folder.path / "log").string());
    process.wait_for([&] { return std::filesystem::exists(begun); });
    CHECK_THAT(verify(folder).output, Contains("another `seam verify --matrix` is at work in this folder"));
  }
  // It was killed: the folder is still its own.
  const Result covered = verify(folder, "--cover solid");
  INFO(covered.output);
  CHECK(covered.code == 1);
  CHECK_THAT(covered.output, Contains("2 variants: 1 ok, 0 known to fall short, 1 failed"));
  CHECK(finding(folder, "types of solid", "coupling:spring").at("holds") == false);
  CHECK_THAT(folder.read("matrix/junit.xml"), Contains("<testsuite name=\"coverage\""));
}
