#include "bendlab/io/disk.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace bendlab {
namespace {

namespace fs = std::filesystem;

/// A file descriptor; -1 if open() failed, with its errno.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : value_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  operator int() const { return value_; }

 private:
  int value_;
};

RunFileError system_error(const fs::path& path, const std::string& what) {
  const int code = errno;
  return file_error(path, what, std::system_category().message(code), code);
}

void synchronise(const fs::path& path, int flags) {
  const Descriptor descriptor(path, flags);
  // A folder on some network file systems refuses fsync with EINVAL: then there is nothing to wait for.
  if (descriptor < 0 || (::fsync(descriptor) != 0 && errno != EINVAL))
    throw system_error(path, "can't be brought to the disk");
}

std::string advice(int code) {
  switch (code) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "Free some space or choose another folder, and run again; what was written before stays "
             "readable";
    case EACCES:
    case EPERM:
    case EROFS:
      return "Choose a folder you may write to, or change its permissions";
    case ENOENT:
    case ENOTDIR:
      return "Check the path; its folder has to exist";
    case EWOULDBLOCK:
      return "Wait for the process that is writing it, or stop that process";
    default:
      return "Check the file and its disk";
  }
}

}  // namespace

RunFileError file_error(const fs::path& path, const std::string& what, const std::string& reason, int code) {
  return RunFileError(fmt::format("{}: {}: {}. {}.", path.string(), what, reason, advice(code)));
}

fs::path part_path(const fs::path& file) {
  return file.string() + ".part";
}

void require_readable(const fs::path& file) {
  if (Descriptor(file, O_RDONLY) >= 0) return;
  const RunFileError error = system_error(file, "can't be read");
  std::error_code ignored;
  if (const auto part = part_path(file); fs::exists(part, ignored))
    throw RunFileError(fmt::format("{} An unfinished run is in '{}'.", error.what(), part.string()));
  throw error;
}

void require_writable(const fs::path& file) {
  const Descriptor descriptor(file, O_RDWR | O_CREAT);
  if (descriptor < 0) throw system_error(file, "can't be written");
  // HDF5 takes the same lock, but only after it has emptied the file.
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw file_error(file, "can't be written", "another writer is at work on it", EWOULDBLOCK);
}

void publish(const fs::path& part, const fs::path& file) {
  synchronise(part, O_RDONLY);
  if (::rename(part.c_str(), file.c_str()) != 0)
    throw system_error(part, fmt::format("can't be renamed to '{}'", file.string()));
  const auto folder = file.parent_path();
  synchronise(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
}

}  // namespace bendlab
