// From a config to a figure: the program runs one of the paper's configs, a script draws it and judges its
// claim.
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/catch.hpp"
#include "tests/places.hpp"

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
  const fs::path source(bendlab::places::source), claims = folder / "claims.json";
  REQUIRE(run(quoted(bendlab::places::program) + " run " + quoted(source / "configs/paper/structure.json") +
              " --out " + quoted(folder) + " >" + quoted(folder / "table")) == 0);
  REQUIRE(run(quoted(bendlab::places::python) + " " + quoted(source / "analysis/fig_structure.py") +
              " --results " + quoted(folder) + " --out " + quoted(folder) + " >" + quoted(claims)) == 0);

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

TEST_CASE("from hard cases to their page", "[experiments]") {
  const fs::path folder = fs::temp_directory_path() / "bendlab_hard_cases", page = folder / "page";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const fs::path source(bendlab::places::source);
  // A crease that no bending sees, and the rest shape: two cases, two models, both precisions.
  REQUIRE(run(quoted(bendlab::places::program) + " run " + quoted(source / "configs/stability/start.json") +
              R"( --set /duration=0.5 --set '/initial=[{"creases": 31}, {}]')"
              R"( --set '/bending/model=["none", "dihedral"]' --out )" +
              quoted(folder) + " >" + quoted(folder / "table")) == 0);
  REQUIRE(run(quoted(bendlab::places::python) + " " + quoted(source / "analysis/stability_page.py") +
              " --results " + quoted(folder) + " --out " + quoted(page) + " >" + quoted(folder / "where")) ==
          0);

  CHECK(fs::file_size(page / "index.html") > 5000);
  CHECK(fs::file_size(page / "fig_stability.png") > 5000);
  CHECK(fs::exists(page / "fig_stability_start_poses.png"));  // something fails
  const auto summary = nlohmann::json::parse(std::ifstream(page / "summary.json"));
  REQUIRE(summary.size() == 8);
  int judged = 0;
  for (const auto& cell : summary) {
    for (const char* key : {"case", "model", "precision", "verdict", "worst", "seconds", "why"})
      CHECK(cell.contains(key));
    if (cell.at("case") == "start: undisturbed" && ++judged > 0) CHECK(cell.at("verdict") == "green");
    if (cell.at("case") == "start: creased" && cell.at("model") == "none" && ++judged > 0)
      CHECK(cell.at("verdict") == "amber");  // folded without strain it stays
  }
  CHECK(judged == 6);
  fs::remove_all(folder);
}
