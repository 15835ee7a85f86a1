#include "bendlab/io/disk.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <random>
#include <system_error>

namespace bendlab {
namespace {

namespace fs = std::filesystem;

/// A file descriptor; -1 if open() failed. errno states the reason.
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

void wait_for_disk(const fs::path& path, int flags) {
  const Descriptor descriptor(path, flags);
  // Some network file systems refuse fsync of a folder with EINVAL. The function ignores this error.
  if (descriptor < 0 || (::fsync(descriptor) != 0 && errno != EINVAL))
    throw system_error(path, "can't be flushed to the disk");
}

std::string advice(int code) {
  switch (code) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "Free some space or choose another folder, and run again; data that were written before can "
             "still be read";
    case EACCES:
    case EPERM:
    case EROFS:
      return "Choose a folder in which you may write, or change the permissions of this folder";
    case ENOENT:
    case ENOTDIR:
      return "Check the path; its folder must exist";
    case EWOULDBLOCK:
      return "Wait until the process that writes this file has ended, or stop the process";
    default:
      return "Check the file and its disk";
  }
}

}  // namespace

RunFileError file_error(const fs::path& path, const std::string& what, const std::string& reason, int code) {
  return RunFileError(fmt::format("{}: {}: {}. {}.", path.string(), what, reason, advice(code)));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw RunFileError(fmt::format("{}: the folder cannot be made: {}; choose another folder with --out",
                                   folder.string(), error.message()));
}

fs::path part_path(const fs::path& file) {
  return file.string() + ".part";
}

void require_readable(const fs::path& file) {
  std::error_code ignored;
  if (const fs::file_status status = fs::status(file, ignored);
      fs::exists(status) && !fs::is_regular_file(status))
    throw file_error(file, "can't be read", "it is no file", 0);
  if (Descriptor(file, O_RDONLY) >= 0) return;
  const RunFileError error = system_error(file, "can't be read");
  if (const auto part = part_path(file); fs::exists(part, ignored))
    throw RunFileError(fmt::format("{} An unfinished run is in '{}'.", error.what(), part.string()));
  throw error;
}

void remove_abandoned(const fs::path& file) {
  const Descriptor descriptor(file, O_RDWR | O_NOFOLLOW | O_NONBLOCK);
  // HDF5 locks files in the same way.
  if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw file_error(file, "can't be written", "another writer is at work on it", EWOULDBLOCK);
  if (::unlink(file.c_str()) != 0 && errno != ENOENT) throw system_error(file, "can't be written");
}

void write_new(const fs::path& file, std::string_view text) {
  const Descriptor descriptor(file, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW);
  if (descriptor < 0) throw system_error(file, "can't be written");
  for (std::string_view rest = text; !rest.empty();) {
    const ssize_t written = ::write(descriptor, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const RunFileError error = system_error(file, "can't be written");
      ::unlink(file.c_str());
      throw error;
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::string unique_token() {
  static const std::uint64_t random = [] {
    std::random_device device;
    return (std::uint64_t{device()} << 32) | device();
  }();
  static std::atomic<std::uint64_t> count{0};
  // Processes that fork() made share `random` and `count`, but not the number of the process.
  return fmt::format("{}-{:016x}-{}", getpid(), random, count++);
}

void replace_file(const fs::path& file, std::string_view text, Wait wait) {
  const fs::path draft = fmt::format("{}.{}.tmp", file.string(), unique_token());
  write_new(draft, text);
  try {
    publish(draft, file, wait);
  } catch (const RunFileError&) {
    ::unlink(draft.c_str());
    throw;
  }
}

void synchronise(const fs::path& file) {
  wait_for_disk(file, O_RDONLY);
}

void publish(const fs::path& part, const fs::path& file, Wait wait) {
  if (wait == Wait::for_disk) synchronise(part);
  if (::rename(part.c_str(), file.c_str()) != 0)
    throw system_error(part, fmt::format("can't be renamed to '{}'", file.string()));
  if (wait == Wait::no) return;
  const auto folder = file.parent_path();
  wait_for_disk(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
}

}  // namespace bendlab
