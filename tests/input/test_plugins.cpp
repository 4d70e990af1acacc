// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <random>

#include "golden.hpp"
#include "seam/plugin/descriptor.hpp"
#include "seam/plugin/plugin_host.hpp"
#include "seam/scene/scene.hpp"
#include "test_types.hpp"

using namespace seam;
using namespace seam_test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

const fs::path golden = fs::path(SEAM_SOURCE_DIR) / "tests/input/golden";

/// The message of loading these plugins, with what depends on the machine replaced.
std::string failure_of(const std::vector<std::string>& names) {
  PluginHost host({SEAM_TEST_PLUGINS});
  Registry registry;
  try {
    host.load(names, registry);
  } catch (const PluginError& e) {
    std::string text = replaced(e.what(), fs::canonical(SEAM_TEST_PLUGINS).string(), "<folder>");
    text = replaced(text, host_fingerprint(), "<fingerprint of this Seam>");
    text = replaced(text, host_headers(), "<headers of this Seam>");
    text = replaced(text, fmt::format("{0}.0 to {0}.{1}", seam::plugin_abi_major, seam::plugin_abi_minor),
                    "<what this Seam takes>");
    const std::string start = "(expected ", mask = "...";
    for (std::size_t i = 0; (i = text.find(start, i)) != std::string::npos;) {
      i += start.size();
      text.replace(i, text.find(')', i) - i, mask);
    }
    return text;
  }
  return "loaded";
}

/// A folder of its own that goes away again.
struct TemporaryFolder {
  fs::path path = fs::temp_directory_path() / ("seam_test_" + std::to_string(std::random_device{}()));
  TemporaryFolder() { fs::create_directory(path); }
  ~TemporaryFolder() { fs::remove_all(path); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

}  // namespace

TEST_CASE("every way in which a plugin fails has its message") {
  for (const std::string name : {"other_abi", "newer_abi", "other_fingerprint", "other_headers", "no_symbol",
                                 "unresolved", "not_a_library", "no_descriptor", "shell", "throws",
                                 "unpromised", "promises_more", "promises_less", "renamed", "beem"}) {
    check_golden(failure_of({name}), golden / ("plugin_" + name + ".txt"));
  }
  check_golden(failure_of({"beam", "beam_again"}), golden / "plugin_duplicate_name.txt");
}

TEST_CASE("the failures of all plugins are collected, and nothing of them stays") {
  PluginHost host({SEAM_TEST_PLUGINS});
  Registry registry;
  try {
    host.load({"throws", "beam", "other_abi", "nowhere"}, registry);
    FAIL("loaded");
  } catch (const PluginError& e) {
    CHECK(e.failures().size() == 3);
  }
  CHECK(registry.find("field", "thrown") == nullptr);
  CHECK(registry.find("field", "beam") != nullptr);
  CHECK(registry.find("field", "beam")->plugin == "beam");
}

TEST_CASE("a plugin loads once, with those it requires, in any order") {
  PluginHost host({SEAM_TEST_PLUGINS});
  Registry registry;
  CHECK(host.provider("field", "shell") == "shell");
  host.load({"shell", "beam"}, registry);
  host.load({"beam"}, registry);
  CHECK(registry.names("field") == std::vector<std::string>{"beam", "shell"});
  CHECK(host.loaded().size() == 2);
  CHECK(host.provider("field", "shell").empty());
  CHECK(host.loaded()[0].info.version == "1.2.3");
}

TEST_CASE("a scene names the plugin that would provide an unknown type") {
  PluginHost host({SEAM_TEST_PLUGINS});
  Registry registry;
  register_test_types(registry);
  const std::string text = replaced(read_text(fs::path(SEAM_SOURCE_DIR) / "tests/input/good.yaml"),
                                    "type: bar, mesh", "type: shell, mesh");
  CHECK_THROWS_WITH(
      parse_scene_text(text, "scene.yaml", {}, host, registry),
      Contains("unknown type 'shell' of field. Plugin 'shell' provides it but is not loaded: add it to "
               "`plugins`"));
}

TEST_CASE("a plugin that the scene does not use is a warning") {
  PluginHost host({SEAM_TEST_PLUGINS});
  Registry registry;
  register_test_types(registry);
  const std::string text =
      "plugins: [beam]\n" + read_text(fs::path(SEAM_SOURCE_DIR) / "tests/input/good.yaml");
  const Scene scene = parse_scene_text(text, "scene.yaml", {}, host, registry);
  CHECK_THAT(scene.warnings.text(),
             Contains("warning: plugin 'beam' is loaded, but the scene uses none of its types"));
}

TEST_CASE("an older minor version is accepted, whatever its headers were") {
  const PluginHost host({SEAM_TEST_PLUGINS});
  const std::vector<PluginHost::Found> found = host.scan();
  const auto older = std::ranges::find(found, "older_minor", &PluginHost::Found::name);
  REQUIRE(older != found.end());
  CHECK(older->info.abi_minor == 0);
  CHECK(older->info.headers.empty());
  // Of the first minor version there is no older one: then it is one of the same with other headers.
  CHECK(older->why_not().empty() == (plugin_abi_minor > 0));
}

TEST_CASE("of two plugins with one name the first that can be used counts, and the other one is told") {
  const TemporaryFolder folder;
  const auto put = [&](const std::string& source, const std::string& into) {
    fs::create_directory(folder.path / into);
    fs::copy(fs::path(SEAM_TEST_PLUGINS) / ("libseam_" + source + ".so"),
             folder.path / into / "libseam_beam.so");
  };
  put("beam", "first");
  put("beam", "second");
  put("other_abi", "stale");
  const PluginHost both({folder.path / "first", folder.path / "second"});
  REQUIRE(both.scan().size() == 1);
  CHECK(both.scan()[0].file == folder.path / "first/libseam_beam.so");
  CHECK(both.scan()[0].hidden == std::vector<fs::path>{folder.path / "second/libseam_beam.so"});
  const PluginHost stale({folder.path / "stale", folder.path / "second"});
  REQUIRE(stale.scan().size() == 1);
  CHECK(stale.scan()[0].file == folder.path / "second/libseam_beam.so");
  CHECK(stale.scan()[0].hidden == std::vector<fs::path>{folder.path / "stale/libseam_beam.so"});

  PluginHost host({folder.path / "first", folder.path / "second"});
  Registry registry;
  register_test_types(registry);
  const std::string text =
      "plugins: [beam]\n" + read_text(fs::path(SEAM_SOURCE_DIR) / "tests/input/good.yaml");
  CHECK_THAT(parse_scene_text(text, "scene.yaml", {}, host, registry).warnings.text(),
             Contains("second/libseam_beam.so', of the same name, is not used; remove one of them"));
}

TEST_CASE("folders that anybody may write to are not searched") {
  const TemporaryFolder folder;
  fs::copy(fs::path(SEAM_TEST_PLUGINS) / "libseam_beam.so", folder.path);
  CHECK(PluginHost({folder.path}).scan().size() == 1);
  fs::permissions(folder.path, fs::perms::others_write, fs::perm_options::add);
  const PluginHost host({folder.path, "/usr/lib"});
  CHECK(host.scan().empty());
  REQUIRE(host.refused().size() == 2);
  CHECK_THAT(host.refused()[0], Contains("everybody may write to it"));
}

TEST_CASE("fingerprints differ where one of them ends early, too") {
  CHECK(fingerprint_difference("a=1 b=2", "a=1 b=2").empty());
  CHECK(fingerprint_difference("a=1", "a=1 b=2") == "nothing (expected b=2)");
  CHECK(fingerprint_difference("a=1 b=2", "a=3") == "a=1 (expected a=3), b=2 (expected nothing)");
}

TEST_CASE("damaged libraries give an error, not a crash") {
  const std::string good = read_text(fs::path(SEAM_TEST_PLUGINS) / "libseam_beam.so");
  CHECK(parse_descriptor(good).name == "beam");
  const PluginDescriptor start;
  const std::size_t descriptor =
      good.find(std::string(start.magic, 8) + std::string({char(plugin_abi_major), 0}));
  REQUIRE(descriptor != std::string::npos);
  for (const char strange : {'\x1b', '\n', '\x7f', '\x80'}) {
    std::string bytes = good;
    bytes[descriptor + offsetof(PluginDescriptor, name)] = strange;
    CHECK_THROWS_WITH(parse_descriptor(bytes), Contains("name is no readable text"));
  }
  for (std::size_t length = 0; length < good.size(); length += 1 + length / 50) {
    CHECK_THROWS_AS(parse_descriptor(good.substr(0, length)), Error);
  }
  std::mt19937 random(3);
  for (int i = 0; i < 5000; ++i) {
    std::string bytes = good;
    // Most of the damage where the structure is: the header and the section table at the end.
    for (int k = 0; k < 8; ++k) {
      const std::size_t at = k % 2 == 0
                                 ? random() % 64
                                 : bytes.size() - 1 - random() % std::min<std::size_t>(4000, bytes.size());
      bytes[at] = static_cast<char>(random());
    }
    try {
      parse_descriptor(bytes);
    } catch (const Error&) {
    }
  }
}
