// What is known about runs without computing them, also while other processes compute them.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "bendlab/io/run_file.hpp"

namespace bendlab {

/// The state of a run on disk.
struct RunState {
  enum class Kind { over, running, failed, interrupted, unreadable, missing } kind = Kind::missing;
  RunRecord record{};    ///< RunDetails::state, if the run is over or interrupted
  std::string reason{};  ///< why the run failed
};

/// The runs in some folders, as on disk when this object was made.
class RunsOnDisk {
 public:
  /// `parents`: the parents of the runs' folders. `unreadable`: as in read_runs().
  RunsOnDisk(const std::set<std::filesystem::path>& parents,
             const std::function<void(const std::string&)>& unreadable);

  /// The state of the run `id` in its folder. Thread-safe.
  RunState state_of(const std::filesystem::path& folder, const std::string& id) const;

 private:
  std::unordered_map<std::string, RunRecord> found_;  // by folder: comparing paths is slow
};

}  // namespace bendlab
