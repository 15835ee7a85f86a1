// The promises of the README about its first experiment and the recommended settings, run like a reader
// would.
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"
#include "tests/places.hpp"

namespace bendlab::readme_test {
using bendlab::test::Workplace;
using nlohmann::json;

namespace {

const std::filesystem::path source = bendlab::places::source;

// The first block of JSON in the README.
std::string first_experiment() {
  const std::string text = bendlab::test::read(source / "README.md"), opening = "```json\n";
  const std::size_t begin = text.find(opening) + opening.size();
  return text.substr(begin, text.find("```", begin) - begin);
}

}  // namespace

TEST_CASE("readme: the first experiment tears with the paper's settings and holds with ours", "[readme]") {
  Workplace place;
  place.write("first.json", first_experiment());
  CHECK(place.run("run first.json --json") == 1);  // the finer sheets with the paper's settings fail
  std::map<std::pair<std::string, int>, json> runs;
  for (const json& line : place.out_lines())
    runs[{line.at("point").at("/defaults"), line.at("point").at("/mesh/cells")}] = line;
  REQUIRE(runs.size() == 6);
  for (const int cells : {16, 32, 64}) {
    CAPTURE(cells);
    const json ours = runs.at({"recommended", cells});
    CHECK(ours.at("status") == "complete");
    CHECK(ours.at("summary").at("max_stretch") <= 1.3);
  }
  CHECK(runs.at({"paper", 64}).at("status") == "implausible");
  CHECK(runs.at({"paper", 64}).at("summary").at("max_stretch") > 1.3);
}

TEST_CASE("readme: the first experiment is also a config file", "[readme]") {
  CHECK(json::parse(first_experiment()) ==
        json::parse(bendlab::test::read(source / "configs" / "first.json")));
}

TEST_CASE("readme: runs with the recommended settings meet the expectations of their config", "[readme]") {
  Workplace place;
  const std::string config = "'" + (source / "configs" / "recommended.json").string() + "'";
  const int code = place.run("run " + config + " --out results --set '/mesh/cells=[16, 32]'");
  INFO(place.err());
  CHECK(code == 0);
}

}  // namespace bendlab::readme_test
