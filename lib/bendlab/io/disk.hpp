// Errors of the disk with advice, and functions whose results survive a power cut.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "bendlab/io/run_file.hpp"

namespace bendlab {

/// "<path>: <what>: <reason>. <what to do>". `code`, an errno or 0, determines what to do.
RunFileError file_error(const std::filesystem::path& path, const std::string& what, const std::string& reason,
                        int code);

/// Makes the folder and its parent folders. Throws RunFileError.
void make_folder(const std::filesystem::path& folder);

/// `file` with the suffix `.part`.
std::filesystem::path part_path(const std::filesystem::path& file);

/// Throws RunFileError if `file` is not a regular file (for example a folder or a pipe), or cannot be read.
void require_readable(const std::filesystem::path& file);

/// Removes a file of an ended writer, or a link with this name. Throws RunFileError if a writer has the file
/// open.
void remove_abandoned(const std::filesystem::path& file);

/// Makes a file with this text. Throws RunFileError, also if a file or a link with this name exists.
void write_new(const std::filesystem::path& file, std::string_view text);

/// Returns a text for the names of new files. No other call, on any machine, returns the same text.
std::string unique_token();

enum class Wait { for_disk, no };

/// Replaces a file in one step: readers see the old text or the new text, also after a power cut. Several
/// processes may replace the file at once. A link with this name is replaced; the file to which the link
/// leads does not change. Throws RunFileError.
void replace_file(const std::filesystem::path& file, std::string_view text, Wait wait = Wait::for_disk);

/// Waits until the file is on the disk. Throws RunFileError.
void synchronise(const std::filesystem::path& file);

/// Flushes `part` to the disk, renames `part` to `file`, and flushes the folder, too. Throws RunFileError.
void publish(const std::filesystem::path& part, const std::filesystem::path& file,
             Wait wait = Wait::for_disk);

}  // namespace bendlab
