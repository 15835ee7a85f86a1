#include "experiments/cli/find_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/campaign/errors.hpp"
#include "experiments/run/checked_read.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

bool is_run_file(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.ends_with(".vtkhdf") || (name.starts_with("run.vtkhdf") && name.ends_with(".part"));
}

/// Every run file below a folder, by path.
std::vector<fs::path> find_run_files(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw RunFileError(fmt::format("there is no folder '{}'", folder.string()));
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && is_run_file(entry.path())) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace

std::vector<RunRecord> read_runs(const fs::path& folder) {
  std::vector<RunRecord> records;
  for (const fs::path& file : find_run_files(folder)) {
    try {
      records.push_back(read_checked(file));
    } catch (const RunFileError& error) {
      fmt::print(stderr, "bendlab: {}\n", error.what());
    }
  }
  return records;
}

RunRecord find_run(const std::string& run, const fs::path& folder) {
  if (fs::is_regular_file(run)) return read_checked(run);
  std::vector<fs::path> files;
  if (fs::is_directory(run)) {
    files = find_run_files(run);
  } else if (fs::is_directory(folder)) {
    for (const RunRecord& record : read_runs(folder))
      if (record.id.starts_with(run)) files.push_back(record.file);
  }
  if (files.size() == 1) return read_checked(files.front());
  if (files.empty())
    throw UsageError(
        fmt::format("'{}' is no run file, no folder with one, and no run in '{}' has an id that begins "
                    "with it; 'bendlab list {}' shows what is there",
                    run, folder.string(), folder.string()));
  std::string all;
  for (const fs::path& file : files) all += "\n  " + file.string();
  throw UsageError(fmt::format("'{}' could be any of {} runs; which one?{}", run, files.size(), all));
}

}  // namespace bendlab
