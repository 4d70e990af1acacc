// SPDX-License-Identifier: BSD-3-Clause
#include "seam/output/safe_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace seam {
namespace {

/// @returns 0, or the value of errno
int write_all(int handle, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(handle, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : EIO;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// A file that was not there before: neither a link nor another process's file is ever written to.
int create_new(const std::string& path) {
  constexpr int flags = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  constexpr mode_t mode = 0666;  // less what the user's mask takes away
  const int handle = ::open(path.c_str(), flags, mode);
  if (handle >= 0 || errno != EEXIST) return handle;
  // A run that was killed while it wrote has left it, or somebody has put a link there.
  if (::unlink(path.c_str()) != 0) return -1;
  return ::open(path.c_str(), flags, mode);
}

/// @returns 0, or the value of errno
int write_new(const std::string& path, std::string_view bytes, Durability durability) {
  const int handle = create_new(path);
  if (handle < 0) return errno;
  int error = write_all(handle, bytes);
  if (error == 0 && durability == Durability::on_disk && ::fsync(handle) != 0) error = errno;
  if (::close(handle) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

std::string describe_system_error(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return fmt::format("the disk (or your share of it) is full: {}; make room there", std::strerror(error));
    case EFBIG:
      return "the file would be larger than this process may write (see `ulimit -f`)";
    case EROFS:
    case EACCES:
    case EPERM:
      return fmt::format("it cannot be written to: {}; choose another --folder, or mend the permissions",
                         std::strerror(error));
    case ENOENT:
      return "its folder is not there (any more)";
    case ENOTDIR:
      return "what should be its folder is a file";
    case ELOOP:
      return "it is a symbolic link, which is not followed";
    default:
      return std::strerror(error);
  }
}

void write_whole_file(const std::string& path, std::string_view bytes, Durability durability) {
  const std::string temporary = path + ".tmp";
  if (const int error = write_new(temporary, bytes, durability)) {
    ::unlink(temporary.c_str());
    throw FileError(Location{path}, "cannot write the file: " + describe_system_error(error));
  }
  if (::rename(temporary.c_str(), path.c_str()) == 0) return;
  const int error = errno;
  ::unlink(temporary.c_str());
  throw FileError(Location{path}, "cannot put the file in place: " + describe_system_error(error));
}

GrowingFile::GrowingFile(std::string path) : path_(std::move(path)) {
  handle_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC);
  if (handle_ < 0) throw FileError(Location{path_}, "cannot open the file: " + describe_system_error(errno));
}

GrowingFile::~GrowingFile() {
  if (handle_ >= 0) ::close(handle_);
}

GrowingFile::GrowingFile(GrowingFile&& other) noexcept
    : path_(std::move(other.path_)), handle_(std::exchange(other.handle_, -1)) {}

GrowingFile& GrowingFile::operator=(GrowingFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(handle_, other.handle_);
  return *this;
}

void GrowingFile::append(std::string_view text) {
  struct stat status {};
  if (::fstat(handle_, &status) != 0)
    throw FileError(Location{path_}, "cannot write the file: " + describe_system_error(errno));
  // Writing to a file without a name succeeds, and is lost.
  if (status.st_nlink == 0)
    throw FileError(Location{path_}, "somebody has deleted the file, or its folder, during the run");
  const int error = write_all(handle_, text);
  if (error == 0) return;
  // Half a line would be read as a wrong number.
  if (::ftruncate(handle_, status.st_size) != 0)
    throw FileError(Location{path_}, "cannot write the file, and its last line is incomplete: " +
                                         describe_system_error(error));
  throw FileError(Location{path_}, "cannot write the file: " + describe_system_error(error));
}

}  // namespace seam
