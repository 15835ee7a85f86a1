// A checksum at the end of every finished run file, after the part that HDF5 reads, so that it moves with the
// file.
//
//   <the HDF5 file> "\nbendlab XXH3-128 " <32 hexadecimal digits of all bytes before> "\n"
//
// XXH3 (https://xxhash.com) detects damage, not malice.
#pragma once

#include <filesystem>

namespace bendlab {

enum class Seal {
  none,    ///< no checksum: an unfinished run file, or a file of another program
  whole,   ///< the file is as it was written
  broken,  ///< the file was changed after it was sealed
};

/// Appends the checksum of the file to it. Throws RunFileError.
void seal(const std::filesystem::path& file);

/// Reads the whole file, at a few GB/s. Throws RunFileError if it cannot be read.
Seal seal_of(const std::filesystem::path& file);

}  // namespace bendlab
