// What earlier processes left in a run's folder: a finished run file, a file of another run, a checkpoint.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "bendlab/io/claim.hpp"
#include "experiments/run/checkpoint.hpp"
#include "experiments/run/run_outcome.hpp"

namespace bendlab {

/// The files that a run writes while it owns its folder, and the checkpoint from which it goes on.
struct RunPlace {
  std::filesystem::path folder, file, part;
  std::string id;
  std::unique_ptr<Claim> claim{};
  std::optional<Checkpoint> saved{};
  EarlierFrames earlier{};  ///< frames that belong to `saved`
  std::string lost{};       ///< why the frames of an earlier process cannot be used
  bool keeps_file = false;  ///< the run is computed again; the old file stays until the new file is whole
};

/// A run's file as it lies on the disk.
struct Found {
  /// Set if the run is complete, or diverged (it would diverge again, bit for bit).
  std::optional<RunOutcome> over;
  std::string wrong;           ///< why the file cannot be the run's; empty if it can be, or is missing
  std::string blas_kernels{};  ///< the BLAS kernels that computed the run
};
Found look_for(const std::filesystem::path& file, const std::string& id);

/// Writes the patch between the program's sources and their commit into a folder of results: `<id>.patch.gz`.
/// Does nothing if there is no patch, if the file exists, or if it can't be written.
void keep_changes(const std::filesystem::path& folder);

/// Renames a file that is not the run's, so that it stays beside the new file. Returns a message about that.
std::string set_aside(const std::filesystem::path& file, const std::string& why, const std::string& token);

/// Renames the finished file of a run that was killed after it wrote its last byte, but before it renamed the
/// file.
void adopt_finished(const RunPlace& place);

/// Finds the checkpoint and a file with all its frames, if both exist.
void find_checkpoint(RunPlace& place);

}  // namespace bendlab
