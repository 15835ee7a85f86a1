// A checksum at the end of every finished run file and of its copies, after the part that HDF5 reads.
//
//   <the HDF5 file> "\nbendlab XXH3-128 " <32 hexadecimal digits of all bytes before> "\n"
//
// XXH3 (https://xxhash.com) detects damage, but no intentional changes.
#pragma once

#include <filesystem>

namespace bendlab {

enum class Seal {
  none,    ///< no checksum: an unfinished run file, or a file of another program
  whole,   ///< the file is as it was written
  broken,  ///< the file was changed after seal()
};

/// Appends the file's checksum to the file. Throws RunFileError.
void seal(const std::filesystem::path& file);

/// Reads the whole file, at a few GB/s. Throws RunFileError if the file cannot be read.
Seal seal_of(const std::filesystem::path& file);

}  // namespace bendlab
