// What is in the finished run files below a folder, so that thousands of them are listed without being
// opened.
//
//   <folder>/runs.index     a line for each file, then the checksum of all lines:
//   path \t size \t modified \t changed \t head \t summary \t provenance \t config
//
// `path` is relative to the folder; `modified` and `changed` are the file's times in ns; the rest is JSON. A
// line counts while the file has the size and times in it, so that a file that was touched, copied or
// replaced is read again. The index is never needed: whoever finds it missing or damaged makes a new one.
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

/// The runs below a folder, by path. Files that the folder's index does not know are read (read_checked), and
/// the index is written anew where it may be. `unreadable` is called with what is wrong with a file.
/// Part::state leaves out what takes long for thousands of runs: summary, provenance and config.
enum class Part { state, all };
std::vector<RunRecord> read_runs(const std::filesystem::path& folder,
                                 const std::function<void(const std::string&)>& unreadable,
                                 Part part = Part::all);

}  // namespace bendlab
