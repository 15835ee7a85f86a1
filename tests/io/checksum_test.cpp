// A change of a finished run file is detected.
#include <fstream>
#include <random>

#include "bendlab/io/checksum.hpp"
#include "tests/catch.hpp"
#include "tests/io/run_fixture.hpp"

namespace bendlab::checksum_test {
using namespace bendlab::test;
namespace fs = std::filesystem;

namespace {

void write_bytes(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace

TEST_CASE("checksum: a changed, cut or longer file is not whole", "[io][checksum]") {
  const TemporaryFolder folder;
  const fs::path file = folder / "run.vtkhdf", changed = folder / "changed";
  write_square_run(file, 5);
  REQUIRE(seal_of(file) == Seal::whole);
  const std::string bytes = bytes_of(file);
  std::mt19937 random(1);
  int undetected = 0;
  for (int i = 0; i < 500; ++i) {
    std::string flipped = bytes;
    char& byte = flipped[std::uniform_int_distribution<std::size_t>(0, bytes.size() - 1)(random)];
    byte = static_cast<char>(byte ^ (1 << std::uniform_int_distribution<int>(0, 7)(random)));
    write_bytes(changed, flipped);
    undetected += seal_of(changed) == Seal::whole;
  }
  CHECK(undetected == 0);
  write_bytes(changed, bytes.substr(0, bytes.size() - 1));
  CHECK(seal_of(changed) == Seal::none);
  write_bytes(changed, bytes + "\n");
  CHECK(seal_of(changed) == Seal::none);
  write_bytes(changed, bytes.substr(1));
  CHECK(seal_of(changed) == Seal::broken);
  write_bytes(changed, "");
  CHECK(seal_of(changed) == Seal::none);
  CHECK_THROWS_AS(seal_of(folder / ""), RunFileError);
}

TEST_CASE("checksum: files without a checksum, and the checksum of an empty file", "[io][checksum]") {
  const TemporaryFolder folder;
  // XXH3 with 128 bits for zero bytes, from the test vectors of its authors.
  write_bytes(folder / "empty", "");
  seal(folder / "empty");
  CHECK(bytes_of(folder / "empty") == "\nbendlab XXH3-128 99aa06d3014798d86001c324468d497f\n");
  CHECK(seal_of(folder / "empty") == Seal::whole);
}

}  // namespace bendlab::checksum_test
