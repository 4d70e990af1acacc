// SPDX-License-Identifier: BSD-3-Clause
#include "series.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

namespace seam_cli_test {

std::vector<std::vector<double>> table(const std::string& csv) {
  std::istringstream in(csv);
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::string cell;
    rows.emplace_back();
    while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

std::vector<double> column(const std::string& csv, const std::string& name) {
  std::istringstream in(csv.substr(0, csv.find('\n')));
  std::string cell;
  std::size_t at = 0;
  while (std::getline(in, cell, ',') && cell != name) ++at;
  REQUIRE(cell == name);
  std::vector<double> result;
  for (const auto& row : table(csv)) result.push_back(row[at]);
  return result;
}

double difference(const std::string& first, const std::string& second, double least) {
  const auto a = table(first), b = table(second);
  REQUIRE(a.size() == b.size());
  REQUIRE(a.size() > 1);
  double worst = 0;
  for (std::size_t column = 0; column < a[0].size(); ++column) {
    double size = least, most = 0;
    for (std::size_t row = 0; row < a.size(); ++row) {
      size = std::max(size, std::abs(a[row][column]));
      most = std::max(most, std::abs(a[row][column] - b[row][column]));
    }
    if (size > 0) worst = std::max(worst, most / size);
  }
  return worst;
}

}  // namespace seam_cli_test
