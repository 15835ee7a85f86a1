#include "experiments/run/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "bendlab/io/disk.hpp"
#include "bendlab/settings/archive.hpp"
#include "bendlab/settings/input_file.hpp"
#include "experiments/run/machine.hpp"
#include "experiments/run/run_id.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

constexpr const char* checkpoint_name = "run.checkpoint";
constexpr double largest_share = 0.01;  // share of a run's time that checkpoints may take

// The bits of a Cholesky factor depend on the BLAS kernels, which are chosen for the processor.
std::string identity(const std::string& id) {
  return fmt::format("bendlab checkpoint\n{}\n{}\n{}\n", id, processor_name(), blas_kernels());
}

}  // namespace

void write_checkpoint(const fs::path& folder, const std::string& id, const Checkpoint& checkpoint) {
  Archive archive;
  std::string text = identity(id), state = checkpoint.state;
  std::uint64_t frames = checkpoint.frames;
  archive(text, frames, state);
  replace_file(folder / checkpoint_name, hex_hash(archive.bytes()) + archive.bytes());
}

std::optional<Checkpoint> read_checkpoint(const fs::path& folder, const std::string& id) try {
  const std::string bytes = read_input_file(folder / checkpoint_name);
  constexpr std::size_t digits = 16;
  if (bytes.size() < digits || hex_hash(bytes.substr(digits)) != bytes.substr(0, digits)) return std::nullopt;
  Archive archive(bytes.substr(digits));
  std::string text;
  Checkpoint checkpoint;
  archive(text, checkpoint.frames, checkpoint.state);
  return text == identity(id) ? std::optional(checkpoint) : std::nullopt;
} catch (const std::runtime_error&) {
  return std::nullopt;
}

void remove_checkpoint(const fs::path& folder) noexcept {
  std::error_code ignored;
  fs::remove(folder / checkpoint_name, ignored);
}

Checkpoints::Checkpoints(fs::path folder, std::string id, FrameWriter& writer, Seconds interval)
    : folder_(std::move(folder)),
      id_(std::move(id)),
      writer_(writer),
      interval_(interval),
      due_(Clock::now() + std::chrono::duration_cast<Clock::duration>(interval)) {}

void Checkpoints::look(std::uint64_t frames, const State& state) {
  if (interval_.count() > 0 && Clock::now() >= due_) now(frames, state);
}

void Checkpoints::now(std::uint64_t frames, const State& state) {
  const Clock::time_point begin = Clock::now();
  writer_.synchronise();
  write_checkpoint(folder_, id_, {frames, state()});
  const Seconds cost = Clock::now() - begin;
  due_ = Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::max(interval_, cost * (1 / largest_share)));
}

}  // namespace bendlab
