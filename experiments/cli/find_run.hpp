// The runs below a folder, and the one that a command's argument means.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bendlab/io/run_file.hpp"

namespace bendlab {

/// The readable runs below a folder, by path; says on stderr which are not. Throws RunFileError if there is
/// no such folder.
std::vector<RunRecord> read_runs(const std::filesystem::path& folder);

/// Files of the runs in a folder whose ids begin with this text; none if there is no such folder.
std::vector<std::filesystem::path> files_by_id(const std::string& beginning,
                                               const std::filesystem::path& folder);

/// The file that `run` names, or nothing. Throws UsageError if it may be several.
std::optional<std::filesystem::path> only_run(const std::string& run,
                                              const std::vector<std::filesystem::path>& files);

/// `run`: a run file, a folder with one, or the beginning of a run's id, looked for in `folder`. Throws
/// UsageError if that is no run, or several.
RunRecord find_run(const std::string& run, const std::filesystem::path& folder);

}  // namespace bendlab
