// Reads a run file that may be damaged, or may be no run file at all. HDF5 may crash on such a file, so only
// a child process lets it parse a file without a right checksum.
#pragma once

#include <filesystem>

#include "bendlab/io/run_file.hpp"

namespace bendlab {

/// Reads a run. A file whose checksum is right is read directly. A file without a checksum (an unfinished
/// run, or a file of another program) is read by a child process, which may crash, and which is killed after
/// ten seconds. An unfinished run that no process computes any more is interrupted. Throws RunFileError, also
/// if the checksum is wrong.
///
/// The child process is this program, with the arguments `read-file FILE`. A program whose main() does not
/// call command_line() cannot answer these arguments, and reads every file itself.
RunRecord read_checked(const std::filesystem::path& file);

/// Declares that this program answers the arguments `read-file FILE`, by print_record().
void answers_read_file();

/// Prints the record of a run as JSON: the work of the child process. Returns the exit code.
int print_record(const std::filesystem::path& file);

}  // namespace bendlab
