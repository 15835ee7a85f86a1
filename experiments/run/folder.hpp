// What earlier processes left in a run's folder: a finished run file, a file of another run, a checkpoint.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "bendlab/io/folder_lock.hpp"
#include "experiments/run/checkpoint.hpp"
#include "experiments/run/run_outcome.hpp"

namespace bendlab {

/// The files that a run writes while it owns its folder, and the checkpoint from which the run continues.
struct RunPlace {
  std::filesystem::path folder, file, part;
  std::string id;
  std::unique_ptr<FolderLock> lock{};
  std::optional<Checkpoint> saved{};
  EarlierFrames earlier{};  ///< frames that belong to `saved`
  std::string lost{};       ///< why the frames of an earlier process cannot be used
  bool keeps_file = false;  ///< the run is computed again; the old file stays until the new file is whole
};

/// The existing file at the path of a run's file, if there is one.
struct Found {
  /// Set if the run is complete or diverged (the run would diverge again, with the same bits).
  std::optional<RunOutcome> over;
  std::string wrong;           ///< why the file cannot be the run's; empty if it can be, or is missing
  std::string blas_kernels{};  ///< the BLAS kernels that computed the run
};
Found look_for(const std::filesystem::path& file, const std::string& id);

/// Writes the differences between the program's sources and their commit into a folder of results, as
/// `<id>.patch.gz`. Does nothing if there are no differences, or if the file exists or can't be written.
void keep_changes(const std::filesystem::path& folder);

/// Renames a file that is not usable as the run's file, to keep it. Returns a message with the new name.
std::string set_aside(const std::filesystem::path& file, const std::string& why);

/// Gives a finished .part file its final name. Such a file exists if the run was killed between its last
/// write and the renaming.
void adopt_finished(const RunPlace& place);

/// Finds the checkpoint and a file that has all frames of the checkpoint, if both files exist.
void find_checkpoint(RunPlace& place);

}  // namespace bendlab
