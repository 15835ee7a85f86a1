// Functions that all fuzzers share. libFuzzer calls LLVMFuzzerTestOneInput() with one input after another. A
// crash, a report of a sanitizer, an unexpected exception or a broken requirement is a finding.
#pragma once

#include <stdlib.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

/// libFuzzer's default mutation of bytes, for use in our mutators. Returns the new size.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace bendlab::fuzz {

/// Stops the fuzzer if `holds` is false. The fuzzer keeps the input.
inline void require(bool holds, std::string_view what) {
  if (holds) return;
  std::fprintf(stderr, "BROKEN: %.*s\n", static_cast<int>(what.size()), what.data());
  std::abort();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Copies a text into libFuzzer's buffer. Returns its size, or 0 if the buffer is too small.
inline std::size_t put(std::string_view text, std::uint8_t* data, std::size_t max_size) {
  if (text.size() > max_size) return 0;
  text.copy(reinterpret_cast<char*>(data), text.size());
  return text.size();
}

/// A folder in memory for this process. It is removed at the end of the process.
inline const std::filesystem::path& folder() {
  struct Folder {
    std::filesystem::path path;
    Folder() {
      std::string name = std::filesystem::is_directory("/dev/shm") ? "/dev/shm/bendlab-fuzz-XXXXXX"
                                                                   : "/tmp/bendlab-fuzz-XXXXXX";
      if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
      path = name;
    }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder temporary;
  return temporary.path;
}

inline void write(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace bendlab::fuzz
