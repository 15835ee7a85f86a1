// Decides which process may write into a folder. At most one process may write at a time, on one machine or
// on several machines that share a disk.
//
//   run.claim.<n>     made by link() or O_EXCL, which are atomic on NFS, too; the highest n counts
//
// The text of the file has the owner's name and a count that grows, the heartbeat. An owner loses the folder
// if its process, on this machine, has ended, or if its count does not grow for the time of a lease. When an
// owner has lost the folder, the process that makes the file n + 1 is the new owner. Every process measures
// the lease with its own clock, because clocks of different machines may differ.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace bendlab {

/// A token that no other call on any machine returns: "<host>-<process>-<random>-<count>".
std::string unique_token();

/// What to do about a folder that another process owns.
enum class WhenOwned {
  wait,          ///< wait until the folder has no owner or a dead owner
  leave_living,  ///< wait until it is known whether the owner lives; leave the folder to a living owner
  leave,         ///< leave the folder at once, unless its owner is known to be dead
};

/// The right to write into a folder, until the object is destroyed.
class Claim {
 public:
  struct Options {
    /// If an owner on another machine writes no heartbeat for this time, it loses the folder.
    std::chrono::duration<double> lease = std::chrono::seconds(60);
    /// Called while waiting. If `give_up` returns true, the wait ends without a claim.
    std::function<bool()> give_up = {};
    /// What to do if the folder has an owner. If the folder is left to its owner, of() returns null.
    WhenOwned when_owned = WhenOwned::wait;
    std::function<void(const std::string&)> waiting_for = {};  ///< called once with the owner's name
  };

  /// Waits until no other thread or process owns the folder. Returns null if `give_up` returns true, or if
  /// the folder is left to its owner. Throws RunFileError if the folder cannot be written.
  static std::unique_ptr<Claim> of(const std::filesystem::path& folder, const Options& options);
  static std::unique_ptr<Claim> of(const std::filesystem::path& folder) { return of(folder, Options{}); }

  ~Claim();
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

  /// Whether this object still owns the folder. If the machine slept for longer than a lease, another process
  /// may own the folder now.
  bool holds() const;
  const std::string& token() const { return token_; }

 private:
  Claim(std::filesystem::path file, std::string token);

  std::filesystem::path file_;
  std::string token_;
};

/// A text that changes at least once per lease while the owner of a folder lives. Empty if the folder seems
/// to have no living owner.
std::string heartbeat_in(const std::filesystem::path& folder);

/// "process 123 on <host>" if the folder seems to have a living owner, and "" otherwise. The function does
/// not wait, so it assumes that an owner on another machine is alive.
std::string owner_of(const std::filesystem::path& folder);

}  // namespace bendlab
