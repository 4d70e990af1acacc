// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <map>

#include "report.hpp"

namespace seam::cli {
namespace {

/// Bytes of the UTF-8 sequence that begins here, 0 for what is none.
std::size_t sequence(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t k) {
    return static_cast<unsigned char>(at + k < text.size() ? text[at + k] : 0);
  };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xc2 && first < 0xe0 ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xc0) != 0x80) return 0;
  // Longer than need be, halves of pairs, beyond the last, and the two that XML excludes.
  if ((first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) >= 0xa0) ||
      (first == 0xf0 && byte(1) < 0x90) || (first == 0xf4 && byte(1) >= 0x90) ||
      (first == 0xef && byte(1) == 0xbf && byte(2) >= 0xbe))
    return 0;
  return length;
}

/// Text of XML 1.0, which has no control characters, not even written as numbers.
std::string xml(const std::string& text) {
  const std::map<char, std::string> escaped{{'&', "&amp;"},  {'<', "&lt;"},   {'>', "&gt;"},
                                            {'"', "&quot;"}, {'\n', "&#10;"}, {'\t', "&#9;"}};
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = sequence(text, at);
    const auto special = escaped.find(text[at]);
    if (special != escaped.end())
      result += special->second;
    else if (length == 0 ||
             (length == 1 && (static_cast<unsigned char>(text[at]) < 0x20 || text[at] == 0x7f)))
      result += '?';
    else
      result += text.substr(at, length);
    at += std::max<std::size_t>(1, length);
  }
  return result;
}

/// The last lines of a log.
std::string tail(const std::filesystem::path& log) {
  constexpr std::streamoff most = 8192;
  std::ifstream in(log, std::ios::binary | std::ios::ate);
  if (!in) return "";
  const std::streamoff size = in.tellg();
  in.seekg(std::max<std::streamoff>(0, size - most));
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A case of a suite.
struct Case {
  enum class Kind { passed, skipped, failure, error };
  std::string name;
  Kind kind = Kind::passed;
  double seconds = 0;
  std::string message;
  std::string text;
};

std::vector<Case> cases_of(const VariantResult& result) {
  const std::string variant = result.name.empty() ? "" : result.name + ": ";
  const std::string repeat = fmt::format("{}\nalone: {}\n", tail(result.log), result.command);
  std::vector<Case> cases;
  for (const Finding& f : result.findings) {
    Case one{variant + f.what, Case::Kind::passed, 0, f.message, ""};
    if (!f.holds && !result.known.empty()) {
      one.kind = Case::Kind::skipped;
      one.message = fmt::format("known: {} ({})", result.known, f.message);
    } else if (!f.holds) {
      one.kind = f.is_broken ? Case::Kind::error : Case::Kind::failure;
      one.text = repeat;
    }
    cases.push_back(std::move(one));
  }
  if (result.holds() && result.verdict() == "FAIL")
    cases.push_back({variant + "known to fall short", Case::Kind::failure, 0,
                     fmt::format("it passes, though it is declared to fall short: {}", result.known),
                     repeat});
  // A variant is one run: its seconds are said once.
  if (!cases.empty()) cases.front().seconds = result.seconds;
  return cases;
}

std::string element(const std::string& name, const Case& one) {
  if (one.kind == Case::Kind::skipped)
    return fmt::format("      <skipped message=\"{}\"/>\n", xml(one.message));
  return fmt::format("      <{} message=\"{}\" type=\"{}\">{}</{}>\n", name, xml(one.message), name,
                     xml(one.text), name);
}

std::string suite(const std::string& scene, const std::vector<Case>& cases) {
  std::map<Case::Kind, int> n;
  double seconds = 0;
  std::string body;
  for (const Case& one : cases) {
    ++n[one.kind];
    seconds += one.seconds;
    body += fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", xml(scene),
                        xml(one.name), one.seconds);
    if (one.kind == Case::Kind::passed)
      body += "/>\n";
    else
      body += ">\n" + element(one.kind == Case::Kind::error ? "error" : "failure", one) + "    </testcase>\n";
  }
  return fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\" "
      "timestamp=\"{:%Y-%m-%dT%H:%M:%S}\">\n{}  </testsuite>\n",
      xml(scene), cases.size(), n[Case::Kind::failure], n[Case::Kind::error], n[Case::Kind::skipped], seconds,
      fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())), body);
}

}  // namespace

std::string as_junit(const std::vector<VariantResult>& results) {
  std::vector<std::string> scenes;
  std::map<std::string, std::vector<Case>> cases;
  for (const VariantResult& result : results) {
    std::vector<Case>& suite_cases = cases[result.scene];
    if (suite_cases.empty()) scenes.push_back(result.scene);
    for (Case& one : cases_of(result)) suite_cases.push_back(std::move(one));
  }
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"seam verify --matrix\">\n";
  for (const std::string& scene : scenes) text += suite(scene, cases[scene]);
  return text + "</testsuites>\n";
}

}  // namespace seam::cli
