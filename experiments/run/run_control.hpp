// How a program watches and stops a run.
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "bendlab/io/claim.hpp"
#include "bendlab/io/run_file.hpp"

namespace bendlab {

/// Runs below these limits write small files, at their end. A crash loses no more than this.
inline constexpr InMemory in_memory{.bytes = 1 << 20, .seconds = 1};

struct RunControl {
  /// If set to true, the run finishes the current frame, keeps it and returns.
  const std::atomic<bool>* stop = nullptr;
  /// Called after every recorded frame: simulated seconds done, simulated seconds in all.
  std::function<void(double done_s, double total_s)> progress;
  bool minimal = false;  ///< leave out effects that provably cannot act, and check that the bits are the same
  /// Compute a run again although it is complete. Its file stays until the new file replaces it.
  bool force = false;
  /// Time between checkpoints, from which a run goes on after a crash, s; 0: only when the run is stopped.
  double checkpoint_interval_s = 10;
  WhenOwned when_owned = WhenOwned::wait;  ///< what to do if another process is computing the run
  /// Called if another process is computing the run, with its name, before this one waits.
  std::function<void(const std::string& owner)> waiting_for;
};

}  // namespace bendlab
