// What lies in a run's folder from before: a finished file, one that is not the run's, a checkpoint.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "bendlab/io/claim.hpp"
#include "experiments/run/checkpoint.hpp"
#include "experiments/run/run_outcome.hpp"

namespace bendlab {

/// What a run writes, where, and from where it goes on, while it owns its folder.
struct RunPlace {
  std::filesystem::path folder, file, part;
  std::string id;
  std::unique_ptr<Claim> claim{};
  std::optional<Checkpoint> saved{};
  EarlierFrames earlier{};  ///< of `saved`
  std::string lost{};       ///< why what an earlier process computed is of no use
  bool keeps_file = false;  ///< until a new one is whole: it is computed again, though it is there
};

/// A run's file as it lies on the disk.
struct Found {
  std::optional<RunOutcome>
      over;                    ///< of a run that is whole, or diverged (which it would again, bit for bit)
  std::string wrong;           ///< why the file cannot be the run's; empty: it may, or there is none
  std::string blas_kernels{};  ///< that it was computed with
};
Found look_for(const std::filesystem::path& file, const std::string& id);

/// Keeps what the program's sources differ in from their commit, in a folder of results: `<id>.patch.gz`.
/// Nothing if they do not, if the file is there, or if it can't be written.
void keep_changes(const std::filesystem::path& folder);

/// Keeps a file that is not the run's beside the new one. Returns what to say of it.
std::string set_aside(const std::filesystem::path& file, const std::string& why, const std::string& token);

/// A run that was killed between its last byte and the renaming of its file is complete: renames it.
void adopt_finished(const RunPlace& place);

/// Finds the checkpoint and a file with all its frames, if there are both.
void find_checkpoint(RunPlace& place);

}  // namespace bendlab
