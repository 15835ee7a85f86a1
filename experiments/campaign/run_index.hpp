// The index of the finished run files below a folder. With the index, thousands of runs can be listed without
// opening their files.
//
//   <folder>/runs.index     a line for each file, then the checksum of all lines:
//   path \t size \t modified \t changed \t head \t summary \t provenance \t config
//
// `path` is relative to the folder; `modified` and `changed` are the file's times in ns. The other columns
// are JSON. A line is valid if its size and times are those of the file. So a file that was touched, copied
// or replaced is read again. The index is only a cache: if it is missing or damaged, the next reader writes
// it again.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bendlab/io/run_file.hpp"

namespace bendlab {

/// Files of runs below a folder, sorted by path: finished ones (run.vtkhdf) and unfinished ones (….part).
/// Throws RunFileError if there is no such folder.
std::vector<std::filesystem::path> find_run_files(const std::filesystem::path& folder);

/// The runs below a folder, sorted by path. Reads files without a valid entry in the folder's index
/// (read_checked), and then writes the index again, if the folder is writable. `unreadable` is called with
/// the error of each file that cannot be read. RunDetails::state leaves out summary, provenance and config,
/// because parsing them takes long for thousands of runs.
enum class RunDetails { state, all };
std::vector<RunRecord> read_runs(const std::filesystem::path& folder,
                                 const std::function<void(const std::string&)>& unreadable,
                                 RunDetails details = RunDetails::all);

}  // namespace bendlab
