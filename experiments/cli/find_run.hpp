// Finds the runs below a folder, and the run that an argument of a command names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "experiments/cli/command.hpp"

namespace bendlab {

/// The readable runs below a folder, sorted by path. Reports unreadable files on stderr. Throws RunFileError
/// if there is no such folder.
std::vector<RunRecord> read_runs(const std::filesystem::path& folder);

/// The files of the runs in `folder` whose ids begin with `beginning`. Empty if there is no such folder.
std::vector<std::filesystem::path> files_by_id(const std::string& beginning,
                                               const std::filesystem::path& folder);

/// The only entry of `files`, or nothing if `files` is empty. Throws UsageError if the argument `run` could
/// mean several files.
std::optional<std::filesystem::path> only_run(const std::string& run,
                                              const std::vector<std::filesystem::path>& files);

/// The run that an argument names: a run file, a folder with a run file, or the beginning of the id of a run
/// in `folder`. Throws UsageError if there is no such run, or if there are several.
RunRecord find_run(const std::string& run, const std::filesystem::path& folder);

/// --results of a command: the folder in which find_run() looks for an id.
void add_results(Command& command, std::string& folder);

/// The argument RUN of a command, and --results.
struct RunArgument {
  std::string run, folder = "results";

  explicit RunArgument(Command& command);
  RunRecord found() const { return find_run(run, folder); }
};

}  // namespace bendlab
