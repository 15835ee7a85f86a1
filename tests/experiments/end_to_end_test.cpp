// From a config to a figure: the program runs one of the paper's configs, and a script draws it and judges a
// claim of the paper.
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/catch.hpp"
#include "tests/places.hpp"

namespace bendlab::end_to_end_test {
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

TEST_CASE("a config of the paper gives a figure and a judged claim", "[experiments]") {
  const fs::path folder = fs::temp_directory_path() / "bendlab_end_to_end";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const fs::path source(bendlab::places::source), page = folder / "page";
  REQUIRE(run(quoted(bendlab::places::program) + " run " + quoted(source / "configs/paper/structure.json") +
              " --out " + quoted(folder) + " >" + quoted(folder / "table")) == 0);
  REQUIRE(run(quoted(bendlab::places::python) + " " + quoted(source / "analysis/page.py") +
              " paper --only structure --results " + quoted(folder) + " --out " + quoted(page) + " >" +
              quoted(folder / "where")) == 0);

  std::ifstream picture(page / "fig_structure.png", std::ios::binary);
  std::string signature(8, '\0');
  REQUIRE(picture.read(signature.data(), 8));
  CHECK(signature == "\x89PNG\r\n\x1a\n");
  CHECK(fs::file_size(page / "fig_structure.png") > 10000);  // an empty canvas would be smaller

  // On a lattice ring r has 6 r vertices. So a free vertex of LOD level m = 2 has 6 + 12 springs, and LOD's t
  // = 3 has 18.
  const auto claim = nlohmann::json::parse(std::ifstream(page / "summary.json")).at(0);
  CHECK(claim.at("holds") == true);
  CHECK(claim.at("numbers").at("Fig. 3: adaptive, m = 2, n = 5: springs of the free vertex") == 18);
  CHECK(claim.at("numbers").at("Fig. 4: LOD, t = 3: springs of the free vertex") == 18);
  fs::remove_all(folder);
}

TEST_CASE("configs of hard cases give their page", "[experiments]") {
  const fs::path folder = fs::temp_directory_path() / "bendlab_hard_cases", page = folder / "page";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const fs::path source(bendlab::places::source);
  // Two cases (a crease that no bending model resists, and the rest shape), two models, both precisions.
  REQUIRE(run(quoted(bendlab::places::program) + " run " + quoted(source / "configs/stability/start.json") +
              R"( --set /duration=0.5 --set '/initial=[{"creases": 31}, {}]')"
              R"( --set '/bending/model=["none", "dihedral"]' --out )" +
              quoted(folder) + " >" + quoted(folder / "table")) == 0);
  REQUIRE(run(quoted(bendlab::places::python) + " " + quoted(source / "analysis/page.py") +
              " stability --results " + quoted(folder) + " --out " + quoted(page) + " >" +
              quoted(folder / "where")) == 0);

  CHECK(fs::file_size(page / "index.html") > 5000);
  CHECK(fs::file_size(page / "fig_stability_start_poses.png") > 5000);  // there is a failing case to draw
  const auto summary = nlohmann::json::parse(std::ifstream(page / "summary.json"));
  REQUIRE(summary.size() == 8);
  int judged = 0;
  for (const auto& cell : summary) {
    for (const char* key : {"case", "model", "precision", "verdict", "worst", "seconds", "why"})
      CHECK(cell.contains(key));
    if (cell.at("case") == "start: undisturbed" && ++judged > 0) CHECK(cell.at("verdict") == "green");
    if (cell.at("case") == "start: creased" && cell.at("model") == "none" && ++judged > 0)
      CHECK(cell.at("verdict") == "amber");  // a fold without strain stays folded
  }
  CHECK(judged == 6);
  fs::remove_all(folder);
}

}  // namespace bendlab::end_to_end_test
