// SPDX-License-Identifier: BSD-3-Clause
#include "seam/output/piece_series.hpp"

#include <fmt/format.h>

#include "seam/base/all_or_none.hpp"

namespace seam {

PieceSeries::PieceSeries(const Communicator& communicator, ResultsFolder& folder, std::string name,
                         double resume_time)
    : communicator_(communicator), folder_(&folder), name_(std::move(name)) {
  all_or_none<FileError>(communicator_, [&] {
    if (communicator_.rank() != 0) return;
    folder_->make_subfolder("fields");
    folder_->claim(name_ + ".pvd");
    const std::string file = (folder_->path() / (name_ + ".pvd")).string();
    series_ = resume_time >= 0 ? PvdSeries::resume(file, resume_time) : PvdSeries(file);
  });
}

std::string PieceSeries::piece_name(const std::string& stem, int rank) const {
  return communicator_.size() == 1 ? stem + ".vtu" : fmt::format("{}-r{}.vtu", stem, rank);
}

void PieceSeries::claim(const std::string& stem, long step_number) {
  for (int r = 0; r < communicator_.size(); ++r) folder_->claim("fields/" + piece_name(stem, r), step_number);
  if (communicator_.size() > 1) folder_->claim("fields/" + stem + ".pvtu", step_number);
}

void PieceSeries::write_files(const std::string& stem, double time, const VtuPiece& piece) {
  const std::filesystem::path fields = folder_->path() / "fields";
  write_vtu((fields / piece_name(stem, communicator_.rank())).string(), piece);
  if (communicator_.rank() != 0) return;
  if (communicator_.size() == 1) return series_.add(time, "fields/" + stem + ".vtu");
  std::vector<std::string> pieces;
  for (int r = 0; r < communicator_.size(); ++r) pieces.push_back(piece_name(stem, r));
  write_pvtu((fields / (stem + ".pvtu")).string(), pieces, piece);
  series_.add(time, "fields/" + stem + ".pvtu");
}

void PieceSeries::write(long step_number, double time, const VtuPiece& piece) {
  const std::string stem = fmt::format("{}-{:06}", name_, step_number);
  // No rank writes a file before it is listed: killed in between, nobody would know whose it is.
  all_or_none<FileError>(communicator_, [&] {
    if (communicator_.rank() == 0) claim(stem, step_number);
  });
  all_or_none<FileError>(communicator_, [&] { write_files(stem, time, piece); });
}

}  // namespace seam
