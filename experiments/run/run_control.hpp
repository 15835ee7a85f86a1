// How a run is watched and stopped.
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "bendlab/io/claim.hpp"
#include "bendlab/io/run_file.hpp"

namespace bendlab {

/// Runs that stay below this write small files. What a crash may cost is not worth more.
inline constexpr InMemory in_memory{.bytes = 1 << 20, .seconds = 1};

struct RunControl {
  const std::atomic<bool>* stop = nullptr;  ///< set: the run finishes the current frame, keeps it and returns
  /// Called after every recorded frame: simulated seconds done, simulated seconds in all.
  std::function<void(double done_s, double total_s)> progress;
  bool minimal = false;  ///< leave out effects that provably cannot act, and check that the bits are the same
  bool force = false;  ///< compute it although its file is complete; that stays until the new one replaces it
  /// How often a run writes what it needs to go on after a crash, s; 0: only when it is stopped.
  double checkpoint_interval_s = 10;
  WhenOwned when_owned = WhenOwned::wait;  ///< what to do if another process is computing it
  /// Called if another process is computing the run, with its name, before this one waits.
  std::function<void(const std::string& owner)> waiting_for;
};

}  // namespace bendlab
