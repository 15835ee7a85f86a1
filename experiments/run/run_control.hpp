// How a program watches and stops a run.
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "bendlab/io/folder_lock.hpp"
#include "bendlab/io/run_file.hpp"

namespace bendlab {

/// A run below these limits keeps its frames in memory until its end. A crash loses at most these frames.
inline constexpr InMemory in_memory{.bytes = 1 << 20, .seconds = 1};

struct RunControl {
  /// If set to true, the run records its current pose and returns.
  const std::atomic<bool>* stop = nullptr;
  /// Called after every recorded frame: simulated seconds done, simulated seconds in all.
  std::function<void(double done_s, double total_s)> progress;
  bool minimal = false;  ///< leave out effects that provably cannot act, and check that the bits are the same
  /// Whether a complete run is computed again. The old file stays until the new file replaces it.
  bool force = false;
  /// Time between checkpoints (checkpoint.hpp), s; 0: only one checkpoint, when the run is stopped.
  double checkpoint_interval_s = 10;
  WhenLocked when_locked = WhenLocked::wait;  ///< what to do if another process is computing the run
  /// Called before this process waits for another process, which is computing the run or a reference of it.
  std::function<void()> waiting;
};

}  // namespace bendlab
