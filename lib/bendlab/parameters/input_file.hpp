// Reads files that a person names: configs and meshes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace bendlab {

constexpr std::uint64_t largest_input_file = std::uint64_t{1} << 32;  ///< bytes

/// All bytes of a file. Throws std::runtime_error with the reason, without the file's name: "is a folder, not
/// a file", for example. Never waits for a pipe, and never reads on without end.
std::string read_input_file(const std::filesystem::path& file, std::uint64_t most = largest_input_file);

}  // namespace bendlab
