#include "bendlab/io/disk.hpp"

#include <fstream>

#include "tests/catch.hpp"
#include "tests/io/run_fixture.hpp"

namespace bendlab::disk_test {
using bendlab::test::TemporaryFolder;
namespace fs = std::filesystem;

TEST_CASE("disk: creating a new file never overwrites an existing file or the target of a link", "[io]") {
  const TemporaryFolder folder;
  std::ofstream(folder / "mine") << "kept";
  fs::create_symlink(folder / "mine", folder / "link");
  CHECK_THROWS_AS(write_new(folder / "mine", "new"), RunFileError);
  CHECK_THROWS_AS(write_new(folder / "link", "new"), RunFileError);
  replace_file(folder / "link", "new");
  CHECK_FALSE(fs::is_symlink(folder / "link"));
  std::string text;
  std::getline(std::ifstream(folder / "mine"), text);
  CHECK(text == "kept");
  std::getline(std::ifstream(folder / "link"), text);
  CHECK(text == "new");
  fs::create_symlink(folder / "mine", folder / "run.vtkhdf.part");
  remove_abandoned(folder / "run.vtkhdf.part");
  CHECK(fs::exists(folder / "mine"));
  CHECK_FALSE(fs::exists(fs::symlink_status(folder / "run.vtkhdf.part")));
}

}  // namespace bendlab::disk_test
