// Files that a user names are read to their end, or refused with the reason. Reading never waits and never
// runs without end.
#include "bendlab/settings/input_file.hpp"

#include <sys/stat.h>

#include <fstream>

#include "tests/catch.hpp"
#include "tests/io/run_fixture.hpp"

namespace bendlab::input_file_test {
using bendlab::test::TemporaryFolder;
using Catch::Matchers::ContainsSubstring;
namespace fs = std::filesystem;

TEST_CASE("input file: everything that is not a regular file is refused", "[input]") {
  const TemporaryFolder folder;
  const auto refusal = [](const fs::path& file, std::uint64_t most = largest_input_file) -> std::string {
    try {
      read_input_file(file, most);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  std::ofstream(folder / "text") << "twelve bytes";
  CHECK(read_input_file(folder / "text", 12) == "twelve bytes");
  CHECK_THAT(refusal(folder / "text", 11), ContainsSubstring("12 bytes"));
  CHECK_THAT(read_input_file("/proc/self/status"), ContainsSubstring("Pid:"));  // its stated size is 0 bytes
  CHECK_THAT(refusal("/proc/self/status", 100), ContainsSubstring("is too large"));
  CHECK_THAT(refusal(folder / "absent"), ContainsSubstring("No such file"));
  CHECK_THAT(refusal(folder / ""), ContainsSubstring("is a folder"));
  CHECK_THAT(refusal("/dev/zero"), ContainsSubstring("a pipe"));
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK_THAT(refusal(folder / "pipe"), ContainsSubstring("a pipe"));
  CHECK_THAT(refusal(folder / std::string(300, 'a')), ContainsSubstring("too long a name"));
  fs::create_symlink("loop", folder / "loop");
  CHECK_THAT(refusal(folder / "loop"), ContainsSubstring("leads back to itself"));
}

}  // namespace bendlab::input_file_test
