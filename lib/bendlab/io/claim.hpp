// Which process may write into a folder: at most one at a time, on one machine or on many that share a disk.
//
//   run.claim.<n>     made by link() or O_EXCL, both atomic on NFS, too; the highest n counts
//
// Its text names the owner and counts up: that is the heartbeat. An owner that is seen to be dead (its
// process on this machine has ended), or whose count stands still for a lease, is succeeded by who makes
// n + 1. Clocks of different machines are not compared: each waits by its own.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace bendlab {

/// Unlike any other made on this machine or another: "<host>-<process>-<random>-<count>".
std::string unique_token();

/// What to do about a folder that another process owns.
enum class WhenOwned {
  wait,          ///< until it has none, or a dead owner
  leave_living,  ///< wait until the owner is seen to live, or to be dead
  leave,         ///< unless its owner is known to be dead at once
};

/// A folder that is claimed by one owner in one process. Released when it ends.
class Claim {
 public:
  struct Options {
    /// A silent owner on another machine is succeeded after this time.
    std::chrono::duration<double> lease = std::chrono::seconds(60);
    std::function<bool()> give_up = {};                        ///< asked while waiting; true: no claim
    WhenOwned when_owned = WhenOwned::wait;                    ///< left: no claim
    std::function<void(const std::string&)> waiting_for = {};  ///< called once with the owner's name
  };

  /// Waits until no other owner, thread or process, has the folder. Returns null if `give_up` says so, or if
  /// the folder is left to its owner. Throws RunFileError if the folder cannot be written.
  static std::unique_ptr<Claim> of(const std::filesystem::path& folder, const Options& options);
  static std::unique_ptr<Claim> of(const std::filesystem::path& folder) { return of(folder, Options{}); }

  ~Claim();
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

  /// Whether it is still ours: an owner that was silent for a lease, in a machine that slept, may have lost
  /// it.
  bool holds() const;
  const std::string& token() const { return token_; }

 private:
  Claim(std::filesystem::path file, std::string token);

  std::filesystem::path file_;
  std::string token_;
};

/// Changes while the owner of a folder lives: compare two, a lease apart. Empty if nobody alive seems to own
/// it.
std::string heartbeat_in(const std::filesystem::path& folder);

/// "process 123 on host h", if somebody alive seems to own the folder, else "". Does not wait: an owner on
/// another machine is taken to be alive.
std::string owner_of(const std::filesystem::path& folder);

}  // namespace bendlab
