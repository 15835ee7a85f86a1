// Checkpoint: a file beside the run file, from which a run goes on after it was stopped or killed, or after a
// power cut.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "bendlab/io/frame_writer.hpp"

namespace bendlab {

struct Checkpoint {
  std::uint64_t frames = 0;  ///< frames of the run file at that time; the file may have more
  std::string state;         ///< an archive of all that the run keeps between steps
};

/// Replaces the checkpoint in `folder` in one step. Throws RunFileError.
void write_checkpoint(const std::filesystem::path& folder, const std::string& id,
                      const Checkpoint& checkpoint);

/// The checkpoint of run `id`. Nothing if it is missing or damaged, or was written for another kind of
/// processor.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder, const std::string& id);

void remove_checkpoint(const std::filesystem::path& folder) noexcept;

/// Writes checkpoints of one run, so seldom that they cost at most 1 % of its time.
class Checkpoints {
 public:
  using Seconds = std::chrono::duration<double>;
  using State = std::function<std::string()>;

  /// `interval`: the shortest time between two checkpoints; 0: only now() writes a checkpoint.
  Checkpoints(std::filesystem::path folder, std::string id, FrameWriter& writer, Seconds interval);

  /// Writes a checkpoint if it is due. `state` is called only then, when all `frames` are in the run file.
  void look(std::uint64_t frames, const State& state);
  /// Writes a checkpoint.
  void now(std::uint64_t frames, const State& state);

 private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path folder_;
  std::string id_;
  FrameWriter& writer_;
  Seconds interval_;
  Clock::time_point due_;
};

}  // namespace bendlab
