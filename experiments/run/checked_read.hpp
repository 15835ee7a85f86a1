// Reads a run file that may be damaged, or may be no run file at all. HDF5 may crash on such a file. So a
// file without a correct checksum is read only in a child process.
#pragma once

#include <filesystem>

#include "bendlab/io/run_file.hpp"

namespace bendlab {

/// Reads a run. A file whose checksum is correct is read directly. A file without a checksum (an unfinished
/// run, or a file of another program) is read by a child process. The child may crash, and is killed after
/// ten seconds. An unfinished run that no process computes gets the status `interrupted`. Throws
/// RunFileError, also if the checksum is wrong.
///
/// The child process is this program, with the arguments `read-file FILE`. A program whose main() does not
/// call command_line() cannot answer these arguments, and reads every file itself.
RunRecord read_checked(const std::filesystem::path& file);

/// Declares that this program answers the arguments `read-file FILE` by a call of print_record().
void answers_read_file();

/// The work of the child process: prints the record of a run as JSON. Returns the exit code.
int print_record(const std::filesystem::path& file);

}  // namespace bendlab
