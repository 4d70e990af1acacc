// SPDX-License-Identifier: BSD-3-Clause
#include "seam/output/piece_series.hpp"

#include <fmt/format.h>

namespace seam {

PieceSeries::PieceSeries(const Communicator& communicator, std::filesystem::path folder, std::string name,
                         double resume_time)
    : communicator_(communicator), folder_(std::move(folder)), name_(std::move(name)) {
  if (communicator_.rank() != 0) return;
  std::filesystem::create_directories(folder_ / "fields");
  const std::string file = (folder_ / (name_ + ".pvd")).string();
  series_ = resume_time >= 0 ? PvdSeries::resume(file, resume_time) : PvdSeries(file);
}

void PieceSeries::write(long step_number, double time, const VtuPiece& piece) {
  const std::string stem = fmt::format("{}-{:06}", name_, step_number);
  const std::filesystem::path fields = folder_ / "fields";
  const auto piece_name = [&](int rank) { return fmt::format("{}-r{}.vtu", stem, rank); };
  if (communicator_.size() == 1) {
    write_vtu((fields / (stem + ".vtu")).string(), piece);
    series_.add(time, "fields/" + stem + ".vtu");
    return;
  }
  write_vtu((fields / piece_name(communicator_.rank())).string(), piece);
  if (communicator_.rank() != 0) return;
  std::vector<std::string> pieces;
  for (int r = 0; r < communicator_.size(); ++r) pieces.push_back(piece_name(r));
  write_pvtu((fields / (stem + ".pvtu")).string(), pieces, piece);
  series_.add(time, "fields/" + stem + ".pvtu");
}

}  // namespace seam
