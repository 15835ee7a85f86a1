// From a config to a figure: the program runs one of the paper's configs, a script draws it and judges its
// claim.
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/catch.hpp"

namespace {

namespace fs = std::filesystem;

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string quoted(const fs::path& path) {
  return "'" + path.string() + "'";
}

}  // namespace

TEST_CASE("from a config to a figure", "[experiments]") {
  const fs::path folder = fs::temp_directory_path() / "bendlab_end_to_end";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const fs::path source(BENDLAB_SOURCE_DIR), claims = folder / "claims.json";
  REQUIRE(run(quoted(BENDLAB_PROGRAM) + " run " + quoted(source / "configs/paper/structure.json") +
              " --out " + quoted(folder) + " >" + quoted(folder / "table")) == 0);
  REQUIRE(run(quoted(BENDLAB_PYTHON) + " " + quoted(source / "analysis/fig_structure.py") + " --results " +
              quoted(folder) + " --out " + quoted(folder) + " >" + quoted(claims)) == 0);

  std::ifstream picture(folder / "fig_structure.png", std::ios::binary);
  std::string signature(8, '\0');
  REQUIRE(picture.read(signature.data(), 8));
  CHECK(signature == "\x89PNG\r\n\x1a\n");
  CHECK(fs::file_size(folder / "fig_structure.png") > 10000);  // an empty canvas compresses to less

  // On a lattice every ring r holds 6 r vertices: a free vertex of level m = 2 has 6 + 12 springs, LOD's t =
  // 3 has 18.
  const auto claim = nlohmann::json::parse(std::ifstream(claims)).at(0);
  CHECK(claim.at("holds") == true);
  CHECK(claim.at("numbers").at("Fig. 3: adaptive, m = 2, n = 5: springs of the free vertex") == 18);
  CHECK(claim.at("numbers").at("Fig. 4: LOD, t = 3: springs of the free vertex") == 18);
  fs::remove_all(folder);
}
