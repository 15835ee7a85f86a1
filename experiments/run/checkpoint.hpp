// What a run needs to go on after it was stopped, killed, or lost its power: a file beside its run file.
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
  std::uint64_t frames = 0;  ///< of the run file, which may have more
  std::string state;         ///< an archive of all that the run keeps between steps
};

/// Replaces the one in `folder` in one step. Throws RunFileError.
void write_checkpoint(const std::filesystem::path& folder, const std::string& id,
                      const Checkpoint& checkpoint);

/// The checkpoint of run `id` by this program on such a processor; nothing if there is none, or a damaged
/// one.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder, const std::string& id);

void remove_checkpoint(const std::filesystem::path& folder) noexcept;

/// Writes checkpoints of one run, so seldom that they cost at most 1 % of its time.
class Checkpoints {
 public:
  using Seconds = std::chrono::duration<double>;
  using State = std::function<std::string()>;

  /// `interval`: the least time between two; 0: none are written but by now().
  Checkpoints(std::filesystem::path folder, std::string id, FrameWriter& writer, Seconds interval);

  /// Writes one if it is due. `state` is asked only then, when all `frames` are in the run file.
  void look(std::uint64_t frames, const State& state);
  /// Writes one.
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
