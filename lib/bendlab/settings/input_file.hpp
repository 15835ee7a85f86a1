// Reads the files that a user names: configs and meshes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace bendlab {

constexpr std::uint64_t largest_input_file = std::uint64_t{1} << 32;  ///< bytes

/// All bytes of a file. Throws std::runtime_error with the reason, for example "is a folder, not a file"; the
/// caller adds the file's name. Refuses pipes, which might never end, and files of more than `most` bytes.
std::string read_input_file(const std::filesystem::path& file, std::uint64_t most = largest_input_file);

}  // namespace bendlab
