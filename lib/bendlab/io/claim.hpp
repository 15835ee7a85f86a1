// Which process may write into a folder: at most one at a time, on one machine or on many that share a disk.
//
//   run.claim.<n>     made by link() or O_EXCL, which are atomic on NFS, too; the highest n counts
//
// The file's text names the owner and holds a count that grows, the heartbeat. An owner loses the folder if
// its process on this machine has ended, or if its count stands still for the time of a lease. Then the
// process that makes the file n + 1 is the new owner. Clocks of different machines are not compared: every
// process waits by its own clock.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace bendlab {

/// A token that is made only once, on this machine and on all others: "<host>-<process>-<random>-<count>".
std::string unique_token();

/// What to do about a folder that another process owns.
enum class WhenOwned {
  wait,          ///< wait until the folder has no owner or a dead owner
  leave_living,  ///< wait until it is known whether the owner lives; leave the folder to a living owner
  leave,         ///< leave the folder at once, unless its owner is known to be dead
};

/// A claim of one owner in one process to a folder. The folder is released when the object is destroyed.
class Claim {
 public:
  struct Options {
    /// After this time, the folder of a silent owner on another machine is taken over.
    std::chrono::duration<double> lease = std::chrono::seconds(60);
    /// Called while waiting. If it returns true, the wait ends without a claim.
    std::function<bool()> give_up = {};
    /// There is no claim to a folder that is left to its owner.
    WhenOwned when_owned = WhenOwned::wait;
    std::function<void(const std::string&)> waiting_for = {};  ///< called once with the owner's name
  };

  /// Waits until no other owner, be it a thread or a process, has the folder. Returns null if `give_up` says
  /// so, or if the folder is left to its owner. Throws RunFileError if the folder cannot be written.
  static std::unique_ptr<Claim> of(const std::filesystem::path& folder, const Options& options);
  static std::unique_ptr<Claim> of(const std::filesystem::path& folder) { return of(folder, Options{}); }

  ~Claim();
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

  /// Whether the folder is still ours. If the machine slept for longer than a lease, another process may have
  /// taken it over.
  bool holds() const;
  const std::string& token() const { return token_; }

 private:
  Claim(std::filesystem::path file, std::string token);

  std::filesystem::path file_;
  std::string token_;
};

/// A text that changes while the owner of a folder lives: compare two texts, taken a lease apart. Empty if
/// the folder seems to have no living owner.
std::string heartbeat_in(const std::filesystem::path& folder);

/// "process 123 on <host>" if the folder seems to have a living owner, else "". Does not wait, so an owner on
/// another machine is assumed to be alive.
std::string owner_of(const std::filesystem::path& folder);

}  // namespace bendlab
