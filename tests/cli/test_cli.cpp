// SPDX-License-Identifier: BSD-3-Clause
// The command line as a user calls it: output and exit codes.
#include <sys/wait.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

using Catch::Matchers::Contains;

namespace {

struct Result {
  int code;
  std::string output;  ///< both streams
};

Result seam(const std::string& arguments) {
  const std::string command =
      "SEAM_PLUGIN_PATH=" SEAM_TEST_PLUGINS " " SEAM_COMMAND " " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  Result result{-1, ""};
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    result.output.append(buffer.data(), n);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
  return result;
}

/// A scene file that goes away again.
struct SceneFile {
  std::filesystem::path path = std::filesystem::temp_directory_path() /
                               ("seam_cli_" + std::to_string(std::random_device{}()) + ".yaml");
  explicit SceneFile(const std::string& text) { std::ofstream(path) << text; }
  ~SceneFile() { std::filesystem::remove(path); }
  SceneFile(const SceneFile&) = delete;
  SceneFile& operator=(const SceneFile&) = delete;
};

const std::string scene =
    "title: A beam\ndimension: 2\nplugins: [beam]\nparameters: {n: 4}\n"
    "meshes: {box: {grid: {from: [0, 0], to: [1, 1], cells: [n, 2]}}}\nfields: {a: {type: beam}}\n";

}  // namespace

TEST_CASE("seam check accepts a scene, with warnings, and reads its meshes") {
  const SceneFile file(scene);
  const Result result = seam("check " + file.path.string() + " --set parameters.n=6");
  CHECK(result.code == 0);
  CHECK_THAT(result.output,
             Contains("mesh box: 12 quadrilateral cells") && Contains("warning: no field uses the mesh"));
}

TEST_CASE("exit codes tell broken input from failing plugins") {
  const SceneFile file(scene + "fieldz: 3\n");
  CHECK(seam("check " + file.path.string()).code == 2);
  CHECK_THAT(seam("check " + file.path.string()).output, Contains("Did you mean 'fields'?"));
  CHECK(seam("check /nowhere/scene.yaml").code == 2);
  CHECK(seam("check " + file.path.string() + " --set nonsense").code == 2);
  CHECK(seam("check").code == 2);
  CHECK(seam("chekc").code == 2);
  CHECK(seam("explain beem").code == 2);
  CHECK(seam("schema --plugins other_abi").code == 3);
  CHECK(seam("check " + file.path.string() + " --set 'plugins=[beam,throws]'").code == 3);
}

TEST_CASE("seam plugins shows what can be used and what cannot") {
  const Result result = seam("plugins");
  CHECK(result.code == 0);
  CHECK_THAT(result.output, Contains("provides: field beam") && Contains("unusable: found plugin ABI 99.0"));
}

TEST_CASE("seam explain and seam schema know the types of plugins") {
  CHECK_THAT(seam("explain").output, Contains("linear_solver") && Contains("A field for the tests. (beam)"));
  CHECK_THAT(seam("explain linear_solver:direct").output, Contains("(plugin core)"));
  const Result result = seam("schema --plugins beam");
  REQUIRE(result.code == 0);
  const auto schema = nlohmann::json::parse(result.output);
  CHECK(schema["$schema"] == "http://json-schema.org/draft-07/schema#");
  CHECK(schema["definitions"]["field"]["oneOf"][0]["enum"] == nlohmann::json({"beam"}));
}
