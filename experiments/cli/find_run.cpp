#include "experiments/cli/find_run.hpp"

#include <fmt/format.h>

#include <system_error>

#include "experiments/campaign/run_index.hpp"
#include "experiments/run/checked_read.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"

namespace bendlab {

namespace fs = std::filesystem;

std::vector<RunRecord> read_runs(const fs::path& folder) {
  return read_runs(folder, [](const std::string& what) { print_text(stderr, "bendlab: {}\n", what); });
}

std::vector<fs::path> files_by_id(const std::string& beginning, const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  if (!fs::is_directory(folder, none)) return files;
  for (const RunRecord& record : read_runs(folder))
    if (record.id.starts_with(beginning)) files.push_back(record.file);
  return files;
}

std::optional<fs::path> only_run(const std::string& run, const std::vector<fs::path>& files) {
  if (files.empty()) return std::nullopt;
  if (files.size() == 1) return files.front();
  std::string all;
  for (const fs::path& file : files) all += "\n  " + file.string();
  throw UsageError(fmt::format("'{}' fits these {} runs; name one run, for example by its file:{}", run,
                               files.size(), all));
}

RunRecord find_run(const std::string& run, const fs::path& folder) {
  std::error_code none;  // ignored: an impossible file name is no file
  if (fs::is_regular_file(run, none)) return read_checked(run);
  const bool is_folder = fs::is_directory(run, none);
  if (const auto file = only_run(run, is_folder ? find_run_files(run) : files_by_id(run, folder)))
    return read_checked(*file);
  throw UsageError(
      fmt::format("'{}' is not a run file, not a folder with a run file, and not the beginning of the id of "
                  "a run in '{}'; 'bendlab list {}' lists the runs in this folder",
                  run, folder.string(), folder.string()));
}

void add_results(Command& command, std::string& folder) {
  command.add(folder, "--results", "Folder in which to look for a run's id");
}

RunArgument::RunArgument(Command& command) {
  command.add(run, "RUN", "A run file, the folder of a run file, or the beginning of a run's id");
  add_results(command, folder);
}

}  // namespace bendlab
