#include "experiments/campaign/runs_on_disk.hpp"

#include <optional>
#include <system_error>

#include "bendlab/io/folder_lock.hpp"
#include "experiments/campaign/campaign.hpp"
#include "experiments/campaign/run_index.hpp"
#include "experiments/run/checked_read.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

// The run in a folder, if the run is over. (It may have ended after RunsOnDisk had read the folder.)
std::optional<RunRecord> ended_since(const fs::path& folder) try {
  const fs::path file = folder / "run.vtkhdf";
  if (!fs::exists(file)) return std::nullopt;
  RunRecord record = read_checked(file);
  return is_over(record.status) ? std::optional(std::move(record)) : std::nullopt;
} catch (const std::exception&) {  // not a run file
  return std::nullopt;
}

}  // namespace

RunsOnDisk::RunsOnDisk(const std::set<fs::path>& parents,
                       const std::function<void(const std::string&)>& unreadable) {
  for (const fs::path& parent : parents) {
    std::error_code none;
    if (!fs::is_directory(parent, none)) continue;
    for (RunRecord& run : read_runs(parent, unreadable, RunDetails::state))
      found_.emplace(run.file.parent_path().string(),
                     std::move(run));  // keeps the first file of a folder: the finished file, if there is one
  }
}

RunState RunsOnDisk::state_of(const fs::path& folder, const std::string& id) const {
  using Kind = RunState::Kind;
  const auto known = found_.find(folder.string());
  const RunRecord* const found = known == found_.end() ? nullptr : &known->second;
  if (found && is_over(found->status) && found->id == id) return {Kind::over, *found};
  if (!found && !fs::exists(folder)) return {};
  if (is_locked(folder)) return {.kind = Kind::running};
  if (auto record = ended_since(folder); record && record->id == id) return {Kind::over, *std::move(record)};
  if (std::string failure = failure_in(folder); !failure.empty())
    return {.kind = Kind::failed, .reason = std::move(failure)};
  if (found && !is_over(found->status)) return {Kind::interrupted, *found};
  const bool has_file = found || fs::exists(folder / "run.vtkhdf") || !unfinished_files(folder).empty();
  return {.kind = has_file ? Kind::unreadable : Kind::missing};
}

}  // namespace bendlab
