#include "bendlab/io/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>

#include "bendlab/io/disk.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr const char* lock_name = "run.lock";

// The locks are "open file description locks" (POSIX.1-2024). A lock belongs to one call of open(), not to
// the process. So threads exclude each other, and closing another descriptor of the file does not release
// the lock. On NFS the file server keeps the locks.
struct flock whole_file(short type) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return lock;
}

// Locks the file, or confirms the lock. 0 or errno; EAGAIN or EACCES: another owner has the lock.
int lock(int descriptor) {
  struct flock all = whole_file(F_WRLCK);
  while (::fcntl(descriptor, F_OFD_SETLK, &all) != 0)
    if (errno != EINTR) return errno;
  return 0;
}

// The lock files that this process has open. A child process of fork() has copies of their descriptors, which
// would keep the locks after the death of the parent. So the child closes its copies.
class LockFiles {
 public:
  static LockFiles& of_this_process() {
    static LockFiles& files = *new LockFiles;  // never destroyed: the process may fork while it exits
    return files;
  }

  // The descriptor of the locked file, or -1 if another owner has the lock.
  int open_locked(const fs::path& file) {
    const std::lock_guard guard(mutex_);  // no fork between open() and insert()
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor < 0) {
      const int code = errno;
      throw file_error(file, "can't be opened", std::system_category().message(code), code);
    }
    const int code = lock(descriptor);
    if (code == 0) {
      open_.insert(descriptor);
      return descriptor;
    }
    ::close(descriptor);
    if (code == EAGAIN || code == EACCES) return -1;
    throw RunFileError(
        fmt::format("{}: can't be locked: {}. Without locks, two processes could compute the same run at the "
                    "same time. Choose a folder on another disk with --out, or mount this disk with locks "
                    "(NFS: version 4; Lustre: option flock).",
                    file.string(), std::system_category().message(code)));
  }

  void close(int descriptor) {
    const std::lock_guard guard(mutex_);
    open_.erase(descriptor);
    struct flock none = whole_file(F_UNLCK);
    ::fcntl(descriptor, F_OFD_SETLK, &none);  // also if a child process has not closed its copy yet
    ::close(descriptor);
  }

 private:
  LockFiles() {
    ::pthread_atfork([] { of_this_process().mutex_.lock(); }, [] { of_this_process().mutex_.unlock(); },
                     [] { of_this_process().forget(); });
  }
  void forget() {  // in a child process
    for (const int descriptor : open_) ::close(descriptor);
    open_.clear();
    mutex_.unlock();
  }

  std::mutex mutex_;
  std::set<int> open_;
};

// Whether the path still leads to the open file. If somebody removed the file after it was opened, another
// process may lock a new file.
bool leads_to(const fs::path& file, int descriptor) {
  struct stat opened {
  }, present{};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(file.c_str(), &present) == 0 &&
         opened.st_dev == present.st_dev && opened.st_ino == present.st_ino;
}

}  // namespace

std::unique_ptr<FolderLock> FolderLock::of(const fs::path& folder, const Options& options) {
  const fs::path file = folder / lock_name;
  bool announced = false;
  for (auto pause = 1ms;; pause = std::min(pause * 2, std::chrono::milliseconds(250))) {
    if (const int descriptor = LockFiles::of_this_process().open_locked(file); descriptor >= 0) {
      if (leads_to(file, descriptor)) return std::unique_ptr<FolderLock>(new FolderLock(file, descriptor));
      LockFiles::of_this_process().close(descriptor);
      continue;
    }
    if (options.when_locked == WhenLocked::leave || (options.give_up && options.give_up())) return nullptr;
    if (!announced && options.waiting) options.waiting();
    announced = true;
    std::this_thread::sleep_for(pause);
  }
}

FolderLock::FolderLock(fs::path file, int descriptor)
    : file_(std::move(file)), descriptor_(descriptor), process_(::getpid()) {}

FolderLock::~FolderLock() {
  if (process_ == ::getpid()) LockFiles::of_this_process().close(descriptor_);
}

bool FolderLock::holds() const {
  return process_ == ::getpid() && leads_to(file_, descriptor_) && lock(descriptor_) == 0;
}

bool is_locked(const fs::path& folder) {
  const int descriptor = ::open((folder / lock_name).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return false;
  struct flock all = whole_file(F_WRLCK);
  const bool locked = ::fcntl(descriptor, F_OFD_GETLK, &all) == 0 && all.l_type != F_UNLCK;
  ::close(descriptor);
  return locked;
}

}  // namespace bendlab
