// A checksum at the end of every finished run file, behind what HDF5 reads: it goes where the file goes.
//
//   <the HDF5 file> "\nbendlab XXH3-128 " <32 hexadecimal digits of all bytes before> "\n"
//
// XXH3 (https://xxhash.com) detects damage, not malice.
#pragma once

#include <filesystem>

namespace bendlab {

enum class Seal {
  none,    ///< no checksum: unfinished, or not ours
  whole,   ///< as it was written
  broken,  ///< changed since
};

/// Appends the checksum of the file to it. Throws RunFileError.
void seal(const std::filesystem::path& file);

/// Reads the whole file, at some GB/s. Throws RunFileError if it cannot be read.
Seal seal_of(const std::filesystem::path& file);

}  // namespace bendlab
