// A checkpoint is a file beside the run file. A run continues from its checkpoint after it was stopped or
// killed, or after a power cut.
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

/// Replaces the checkpoint in `folder` atomically. Throws RunFileError.
void write_checkpoint(const std::filesystem::path& folder, const std::string& id,
                      const Checkpoint& checkpoint);

/// The checkpoint of run `id`. Nothing if this checkpoint is missing or damaged, or was written on another
/// kind of processor.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder, const std::string& id);

void remove_checkpoint(const std::filesystem::path& folder) noexcept;

/// Writes checkpoints of one run, so rarely that they cost at most 1 % of the run's time.
class Checkpoints {
 public:
  using Seconds = std::chrono::duration<double>;
  using State = std::function<std::string()>;

  /// `interval`: the shortest time between two checkpoints; 0: only now() writes a checkpoint.
  Checkpoints(std::filesystem::path folder, std::string id, FrameWriter& writer, Seconds interval);

  /// Writes a checkpoint if the interval is over. Calls `state` when all `frames` are in the run file.
  void look(std::uint64_t frames, const State& state);
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
