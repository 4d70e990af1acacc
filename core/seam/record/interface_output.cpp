// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/interface_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "seam/assembly/element.hpp"
#include "seam/assembly/evaluator.hpp"
#include "seam/base/all_or_none.hpp"
#include "seam/field/field.hpp"
#include "seam/output/atomic_file.hpp"

namespace seam {
namespace {

constexpr const char* axes[] = {"x", "y", "z"};

/// Of a point: where the first and the second side have it, and its weight.
void put_place(const Element& element, int point, std::size_t dimension, double* row) {
  const std::vector<ElementSide>& sides = element.sides;
  for (const ElementSide* side : {&sides.front(), &sides.at(std::min<std::size_t>(1, sides.size() - 1))})
    row = std::copy_n(&side->position[point * dimension], dimension, row);
  *row = element.weight[point];
}

}  // namespace

InterfaceOutput::InterfaceOutput(const Problem& problem, ResultsFolder& folder)
    : communicator_(problem.communicator()), folder_(&folder) {
  for (const InterfaceMeasure& measure : problem.measures()) {
    if (measure.integrals.empty()) continue;
    Interface& interface = interfaces_[measure.interface];
    interface.dimension = measure.integrals.front().domain->fields().front()->mesh().dimension();
    Column column{measure.name, {}, 1};
    for (const auto& [domain, quantity] : measure.integrals) {
      column.quantities[domain].push_back(quantity);
      column.components = quantity.term->signature(interface.dimension).values;
      if (std::ranges::find(interface.domains, domain) == interface.domains.end())
        interface.domains.push_back(domain);
    }
    interface.columns.push_back(std::move(column));
  }
}

/// [point][place, place in the body, weight, columns], of this rank.
std::vector<double> InterfaceOutput::rows(const Interface& interface, const TimePoint& at) {
  const auto dim = static_cast<std::size_t>(interface.dimension);
  std::size_t places = 2 * dim + 1, width = places;
  for (const Column& column : interface.columns) width += column.components;
  std::vector<double> result;
  for (const Domain& domain : interface.domains) {
    const std::size_t first = result.size();
    std::size_t at_column = places;
    for (const Column& column : interface.columns) {
      const auto components = static_cast<std::size_t>(column.components);
      const auto found = column.quantities.find(domain);
      for (std::size_t k = 0; found != column.quantities.end() && k < found->second.size(); ++k) {
        ElementEvaluator evaluator(*domain, {found->second[k]});
        std::size_t row = first;
        for (int e = 0; e < domain->size(); ++e) {
          const std::vector<double>& values = evaluator.compute_values(e, at);
          const Element& element = evaluator.element();
          for (int q = 0; q < element.points; ++q, row += width) {
            if (row == result.size()) {
              result.resize(row + width, std::numeric_limits<double>::quiet_NaN());
              put_place(element, q, dim, &result[row]);
            }
            for (std::size_t c = 0; c < components && !values.empty(); ++c) {
              double& sum = result[row + at_column + c];
              sum = (std::isnan(sum) ? 0 : sum) + values[q * components + c];
            }
          }
        }
      }
      at_column += components;
    }
  }
  return result;
}

void InterfaceOutput::write_table(const std::string& name, long step_number, double time,
                                  const std::vector<double>& table) const {
  const Interface& interface = interfaces_.at(name);
  std::vector<std::string> header(axes, axes + interface.dimension);
  for (int d = 0; d < interface.dimension; ++d) header.push_back(fmt::format("body_{}", axes[d]));
  header.emplace_back("weight");
  for (const Column& column : interface.columns)
    for (int c = 0; c < column.components; ++c)
      header.push_back(column.components == 1 ? column.name : fmt::format("{}.{}", column.name, axes[c]));
  std::string text = fmt::format("time,{}\n", fmt::join(header, ","));
  for (auto row = table.begin(); row != table.end(); row += static_cast<std::ptrdiff_t>(header.size()))
    text += fmt::format("{:.12g},{:.9g}\n", time,
                        fmt::join(row, row + static_cast<std::ptrdiff_t>(header.size()), ","));
  const std::string file = fmt::format("interfaces/{}-{:08}.csv", name, step_number);
  folder_->claim(file, step_number);
  write_text_atomically((folder_->path() / file).string(), text);
}

void InterfaceOutput::write(long step_number, const TimePoint& at) const {
  for (const auto& [name, interface] : interfaces_) {
    const std::vector<double> table = communicator_.gather_all(rows(interface, at));
    all_or_none<FileError>(communicator_, [&, &of = name] {
      if (communicator_.rank() == 0) write_table(of, step_number, at.time, table);
    });
  }
}

}  // namespace seam
