// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "seam/base/diagnostics.hpp"

namespace seam {

/// A file or folder of results that cannot be written: a full disk, a folder that is read-only or gone. What
/// a run has computed is not to blame, so that it can be resumed.
class FileError : public Error {
 public:
  using Error::Error;
};

/// What the system says, in words, with what to do about it. @param error a value of errno
std::string describe_system_error(int error);

enum class Durability {
  buffered,  ///< the system writes it to disk when it likes: it survives the end of this process
  on_disk    ///< it survives a power failure, too; costs some milliseconds
};

/// Puts a file in place as a whole: first beside it, by the name `path`.tmp, which then takes its name. A
/// reader, or a process that is killed, never leaves half of it. Links of either name are replaced, never
/// followed.
/// @throws FileError naming the file and the system's reason; then the file is as it was
void write_whole_file(const std::string& path, std::string_view bytes,
                      Durability durability = Durability::buffered);

/// A text file that grows. What append() has written is read by others at once and survives the end of this
/// process.
class GrowingFile {
 public:
  GrowingFile() = default;
  /// Opens a file that is there. @throws FileError also when it is a link
  explicit GrowingFile(std::string path);
  ~GrowingFile();
  GrowingFile(GrowingFile&& other) noexcept;
  GrowingFile& operator=(GrowingFile&& other) noexcept;
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  [[nodiscard]] bool is_open() const { return handle_ >= 0; }
  /// All of it, or nothing. @throws FileError, also when somebody has deleted the file
  void append(std::string_view text);

 private:
  std::string path_;
  int handle_ = -1;
};

}  // namespace seam
