// Errors of the disk with advice, and a rename that survives a power cut.
#pragma once

#include <filesystem>
#include <string>

#include "bendlab/io/run_file.hpp"

namespace bendlab {

/// "<path>: <what>: <reason>. <what to do>"; `code` is the errno that chooses the advice, 0 for none.
RunFileError file_error(const std::filesystem::path& path, const std::string& what, const std::string& reason,
                        int code);

/// `file` with the suffix `.part`.
std::filesystem::path part_path(const std::filesystem::path& file);

/// Throws RunFileError unless the file can be opened for reading.
void require_readable(const std::filesystem::path& file);

/// Creates the file if it does not exist. Throws RunFileError unless it can be written and no other writer
/// has it open.
void require_writable(const std::filesystem::path& file);

/// Flushes `part` to the disk, renames it to `file` and flushes the rename. Throws RunFileError.
void publish(const std::filesystem::path& part, const std::filesystem::path& file);

}  // namespace bendlab
