#include "bendlab/io/checksum.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <memory>
#include <system_error>
#include <vector>

#include "bendlab/io/disk.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = "\nbendlab XXH3-128 ";
constexpr std::size_t digits = 32, seal_length = mark.size() + digits + 1;

// The checksum of the file's first `bytes` bytes.
std::string checksum_of(const fs::path& file, std::uint64_t bytes) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> block(std::min<std::uint64_t>(bytes, 1 << 20));
  for (std::uint64_t rest = bytes; rest > 0;) {
    const auto wanted = static_cast<std::streamsize>(std::min<std::uint64_t>(rest, block.size()));
    if (!stream.read(block.data(), wanted))
      throw file_error(file, "can't be read", std::system_category().message(errno), errno);
    XXH3_128bits_update(state.get(), block.data(), static_cast<std::size_t>(wanted));
    rest -= static_cast<std::uint64_t>(wanted);
  }
  const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string end_of(const fs::path& file, std::uint64_t size) {
  std::string end(seal_length, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(size - seal_length));
  return stream.read(end.data(), static_cast<std::streamsize>(seal_length)) ? end : "";
}

}  // namespace

void seal(const fs::path& file) {
  const std::string checksum = checksum_of(file, fs::file_size(file));
  errno = 0;
  std::ofstream stream(file, std::ios::binary | std::ios::app);
  stream << mark << checksum << '\n' << std::flush;
  if (!stream) throw file_error(file, "can't be finished", std::system_category().message(errno), errno);
}

Seal seal_of(const fs::path& file) {
  require_readable(file);
  const std::uint64_t size = fs::file_size(file);
  if (size < seal_length) return Seal::none;
  const std::string end = end_of(file, size);
  if (!end.starts_with(mark) || !end.ends_with('\n')) return Seal::none;
  return end.substr(mark.size(), digits) == checksum_of(file, size - seal_length) ? Seal::whole
                                                                                  : Seal::broken;
}

}  // namespace bendlab
