// Reading a run file that may be damaged, or no run file at all: HDF5 parses nothing here that nobody vouches
// for.
#pragma once

#include <filesystem>

#include "bendlab/io/run_file.hpp"

namespace bendlab {

/// Reads a run. A file whose checksum is right is read at once; one without checksum (an unfinished run, or a
/// file of others) by a child process, which may crash, and is ended after ten seconds. An unfinished run
/// that nobody computes any more is interrupted. Throws RunFileError, also if the checksum is wrong.
///
/// The child is this program, with the arguments `read-file FILE`. A program that does not answer them,
/// because its main() does not come to command_line(), reads every file itself.
RunRecord read_checked(const std::filesystem::path& file);

/// Says that this program answers these arguments, by print_record().
void answers_read_file();

/// What the child process does: prints the record as JSON. Returns the exit code.
int print_record(const std::filesystem::path& file);

}  // namespace bendlab
