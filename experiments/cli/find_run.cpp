#include "experiments/cli/find_run.hpp"

#include <fmt/format.h>

#include <system_error>

#include "experiments/campaign/errors.hpp"
#include "experiments/campaign/run_index.hpp"
#include "experiments/run/checked_read.hpp"
#include "experiments/terminal/printable.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

void tell(const std::string& what) {
  print_text(stderr, "bendlab: {}\n", what);
}

}  // namespace

std::vector<RunRecord> read_runs(const fs::path& folder) {
  return read_runs(folder, tell);
}

RunRecord find_run(const std::string& run, const fs::path& folder) {
  std::error_code none;  // a name that no file can have names no file
  if (fs::is_regular_file(run, none)) return read_checked(run);
  std::vector<fs::path> files;
  if (fs::is_directory(run, none)) {
    files = find_run_files(run);
  } else if (fs::is_directory(folder, none)) {
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
