// Decides which process may write into a folder: the process that holds the kernel's lock on the file
// `run.lock` in this folder. At most one object holds the lock, in all processes on all machines that share
// the disk. The kernel releases the lock when the process ends, however the process ends.
//
// The file is empty, and stays in the folder. If a process removed the file, another process could still wait
// for the lock of the removed file while a third process locks a new file.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

namespace bendlab {

/// What to do about a folder that is locked.
enum class WhenLocked {
  wait,   ///< wait until the lock is released
  leave,  ///< leave the folder to its owner
};

/// The right to write into a folder, until the object is destroyed. After fork(), only the parent process has
/// this right.
class FolderLock {
 public:
  struct Options {
    WhenLocked when_locked = WhenLocked::wait;
    std::function<bool()> give_up = {};  ///< called while waiting; true ends the wait without a lock
    std::function<void()> waiting = {};  ///< called once before the wait
  };

  /// Returns null if `give_up` returns true, or if the folder is left to its owner. Throws RunFileError if
  /// the folder cannot be written, or if its file system has no locks.
  static std::unique_ptr<FolderLock> of(const std::filesystem::path& folder, const Options& options);
  static std::unique_ptr<FolderLock> of(const std::filesystem::path& folder) { return of(folder, Options{}); }

  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Whether this object has the lock, at the end as at the start. The lock is lost if somebody removes the
  /// file, or if a file server releases the lock because it did not hear from this machine for too long. A
  /// lock that was lost and that nobody holds now is taken again: then another process may have had it
  /// meanwhile.
  bool holds() const;

 private:
  FolderLock(std::filesystem::path file, int descriptor);

  std::filesystem::path file_;
  int descriptor_;
  long process_;  // that made this object; a child process has a copy of the object, but not the lock
};

/// Whether a process holds the lock of a folder. Does not disturb processes that try to lock the folder.
bool is_locked(const std::filesystem::path& folder);

}  // namespace bendlab
