// One run: a point of a sweep, from its config to its file. Knows no command line and prints nothing.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "bendlab/io/claim.hpp"
#include "bendlab/io/run_file.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/scene/start_after.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/broken_bound.hpp"
#include "experiments/run/warnings.hpp"

namespace bendlab {

/// Runs that stay below this write small files. What a crash may cost is not worth more.
inline constexpr InMemory in_memory{.bytes = 1 << 20, .seconds = 1};

/// How a run is watched and stopped.
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

struct RunOutcome {
  std::string id;
  RunStatus status = RunStatus::complete;
  bool differs = false;  ///< `minimal` changed a bit: an effect that could not act did
  bool reused = false;   ///< the file was there and complete; nothing was computed
  bool left = false;     ///< another process is computing it, and was left to it
  std::filesystem::path file;
  std::optional<BrokenBound> broken{};  ///< why it is implausible; also of a run that diverged after that
  std::vector<Warning> warnings{};
  std::string message;  ///< where and when it diverged, how to resume, …; may be empty
  double wall_s = 0, cpu_s = 0;
  double step_cpu_s = 0;  ///< of the steps alone, without set-up and recording
  std::map<std::string, double> summary;
  std::vector<PassTime> passes;
};

/// 16 hex digits of XXH3.
std::string hex_hash(const std::string& text);

/// Hash (16 hex digits) of the resolved config, the bytes of the files that it names, the program's sources,
/// its file where they are not all ours (own_code.hpp), and the ids of the runs that it starts after or is
/// compared with.
std::string run_id(const RunConfig& config);

/// `<out>/<experiment>/<readable place on the sweep>-<id>`; the id where it is known.
std::filesystem::path run_folder(const std::filesystem::path& out, const Experiment& experiment,
                                 const RunConfig& config);
std::filesystem::path run_folder(const std::filesystem::path& out, const Experiment& experiment,
                                 const RunConfig& config, const std::string& id);

/// Computes a run, or reads it if it is complete. While it is computed its folder is claimed (claim.hpp): who
/// comes second waits, and finds it complete. A file that was changed, or is another run's, is set aside. A
/// run that was stopped, killed, or lost its power goes on from its last checkpoint, and gives the same bits.
///
/// With config.starts_at_end_of it starts from `start`. The references that it is compared with are made
/// below <out>/<experiment>; their time is not the run's. Throws MeshError, RunFileError, and
/// NoRoom before anything is allocated; a run that diverges is an outcome.
RunOutcome execute_run(const Experiment& experiment, const RunConfig& config,
                       const std::filesystem::path& out, const RunControl& control = {},
                       const StartingPose* start = nullptr);

}  // namespace bendlab
