// SPDX-License-Identifier: BSD-3-Clause
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "seam/base/policy.hpp"

namespace seam::cli {
namespace {

/// How a variant is called where its scene is not said with it.
std::string called(const VariantResult& result) { return result.name.empty() ? "as it stands" : result.name; }

std::string indented(const std::string& text, const std::string& by) {
  std::string result = by;
  for (const char c : text) result += c == '\n' ? "\n" + by : std::string(1, c);
  return result;
}

/// What is said below a variant: all that does not hold.
std::string shortfalls(const VariantResult& result) {
  std::string text;
  for (const Finding& finding : result.findings)
    if (!finding.holds)
      text += indented(fmt::format("{}: {}", finding.what, finding.message), "       ") + "\n";
  if (result.holds() && result.verdict() == "FAIL")
    text += fmt::format(
        "       it passes, though it is declared to fall short ({}): take it out of `matrix.known`\n",
        result.known);
  return text;
}

/// Of a table in Markdown.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c == '\n' ? ' ' : c);
  return result;
}

}  // namespace

MatrixCount count(const std::vector<VariantResult>& results) {
  MatrixCount count;
  for (const VariantResult& result : results) {
    const std::string verdict = result.verdict();
    ++(verdict == "ok"      ? count.ok
       : verdict == "known" ? count.known
       : verdict == "FAIL"  ? count.failed
                            : count.not_run);
  }
  return count;
}

std::string as_text(const VariantResult& result, bool is_pending) {
  // A known variant that holds so far may still disagree with others.
  const bool is_open = is_pending && !result.known.empty() && result.holds();
  std::string text =
      fmt::format("{:<5} {}: {} ({} {}, {:.2f} s)\n", is_open ? "ran" : result.verdict(),
                  on_one_line(result.scene), on_one_line(called(result)), result.findings.size(),
                  result.findings.size() == 1 ? "finding" : "findings", result.seconds);
  if (is_open) return text;
  if (result.verdict() == "known") return text + "       " + on_one_line(result.known) + "\n";
  text += shortfalls(result);
  if (result.verdict() == "FAIL") {
    if (!result.log.empty()) text += "       log: " + on_one_line(result.log.string()) + "\n";
    if (!result.command.empty()) text += "       alone: " + on_one_line(result.command) + "\n";
  }
  return text;
}

std::string as_markdown(const std::vector<VariantResult>& results,
                        const std::vector<std::pair<std::string, std::string>>& circumstances) {
  const MatrixCount n = count(results);
  std::string text = "# Variants\n\n| | |\n|---|---|\n";
  for (const auto& [name, value] : circumstances) text += fmt::format("| {} | {} |\n", name, cell(value));
  text += fmt::format("\n{} variants: {} ok, {} known to fall short, {} failed.\n\n", results.size(), n.ok,
                      n.known, n.failed);
  text += "| scene | variant | result | holds | s | MB |\n|---|---|---|---:|---:|---:|\n";
  for (const VariantResult& r : results)
    text += fmt::format("| {} | {} | {} | {} of {} | {:.1f} | {:.0f} |\n", cell(r.scene), cell(called(r)),
                        r.verdict(), std::ranges::count_if(r.findings, &Finding::holds), r.findings.size(),
                        r.seconds, r.bytes / 1e6);
  for (const VariantResult& r : results)
    if (r.verdict() != "ok")
      text += fmt::format("\n`{}`: {}\n\n```\n{}```\n", r.scene, called(r), as_text(r));
  return text;
}

nlohmann::json as_json(const std::vector<VariantResult>& results) {
  auto rows = nlohmann::json::array();
  for (const VariantResult& r : results) {
    auto findings = nlohmann::json::array();
    for (const Finding& f : r.findings)
      findings.push_back(
          {{"what", f.what}, {"holds", f.holds}, {"broken", f.is_broken}, {"message", f.message}});
    auto values = nlohmann::json::object();
    for (const auto& [key, value] : r.values) values[key] = value;
    rows.push_back({{"scene", r.scene},
                    {"variant", r.name},
                    {"values", values},
                    {"verdict", r.verdict()},
                    {"known", r.known},
                    {"seconds", r.seconds},
                    {"peak_memory_bytes", r.bytes},
                    {"log", r.log.string()},
                    {"command", r.command},
                    {"findings", findings}});
  }
  return rows;
}

}  // namespace seam::cli
