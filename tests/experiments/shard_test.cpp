// Shards of a sweep, and several processes that compute the same sweep.
#include <algorithm>
#include <fstream>
#include <set>
#include <thread>

#include "bendlab/io/folder_lock.hpp"
#include "experiments/campaign/campaign.hpp"
#include "experiments/run/errors.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

namespace bendlab::shard_test {
using namespace bendlab::test;
namespace fs = std::filesystem;

namespace {

constexpr const char* sweep =
    R"({"name": "sheet", "duration": 0.1, "mesh": {"cells": 2}, "sweep": {"/mesh/cells": [1, 2, 3, 4]}})";

std::size_t computed(const std::vector<nlohmann::json>& runs) {
  return static_cast<std::size_t>(
      std::ranges::count_if(runs, [](const auto& run) { return !run.at("reused"); }));
}

}  // namespace

TEST_CASE("shards: every run of a campaign belongs to exactly one shard", "[campaign]") {
  std::vector<Experiment> experiments;
  for (const char* name : {"one", "two"})
    experiments.push_back(parse_experiment(
        std::string(R"({"name": ")") + name + R"(", "sweep": {"/mesh/cells": [1, 2, 3, 4, 5]}})", name));
  for (const std::size_t count : {1u, 2u, 3u, 10u, 11u}) {
    std::multiset<const RunConfig*> all;
    for (std::size_t index = 0; index < count; ++index) {
      const std::vector<CampaignRun> part = plan_campaign(experiments, {index, count});
      CHECK(part.size() >= 10 / count);
      CHECK(part.size() <= (10 + count - 1) / count);
      for (const CampaignRun& run : part) all.insert(run.config);
    }
    std::multiset<const RunConfig*> expected;
    for (const CampaignRun& run : plan_campaign(experiments)) expected.insert(run.config);
    CHECK(all == expected);
    CHECK(all.size() == 10);
  }
  for (const char* text :
       {"2/2", "1", "a/b", "1/2x", "-1/2", "0/0", "0/-8", "0/ 8", "+0/8", "0/99999999999999999999", ""})
    CHECK_THROWS_AS(shard_of(text), UsageError);
  CHECK(shard_of("2/8").index == 2);
  CHECK(shard_of("2/8").count == 8);
}

TEST_CASE("shards: together they compute the sweep, which run then collects", "[campaign]") {
  Workplace place;
  place.write("sweep.json", sweep);
  REQUIRE(place.run("plan sweep.json --json") == 0);
  for (const auto& line : place.out_lines()) CHECK(line.at("state") == "missing");
  std::set<std::string> ids;
  for (const char* shard : {"0/3", "1/3", "2/3"}) {
    REQUIRE(place.run(std::string("run sweep.json --json --shard ") + shard) == 0);
    CHECK(computed(place.out_lines()) == place.out_lines().size());
    for (const auto& line : place.out_lines()) ids.insert(line.at("id"));
  }
  CHECK(ids.size() == 4);
  REQUIRE(place.run("run sweep.json --json") == 0);
  CHECK(place.out_lines().size() == 4);
  CHECK(computed(place.out_lines()) == 0);
  REQUIRE(place.run("plan sweep.json") == 0);
  CHECK(place.out().find("4 complete") != std::string::npos);
  CHECK(place.run("run sweep.json --shard 3/3") == exit_usage);
}

TEST_CASE("run: runs that another process is computing are put off, and not computed twice", "[campaign]") {
  Workplace place;
  place.write("sweep.json", sweep);
  REQUIRE(place.run("plan sweep.json --json") == 0);
  const fs::path folder = place.folder / place.out_lines().at(3).at("folder").get<std::string>();
  fs::create_directories(folder);
  auto owner = FolderLock::of(folder);  // of the largest run, which would be computed first
  REQUIRE(place.run("plan sweep.json --json") == 0);
  CHECK(place.out_lines().at(3).at("state") == "running");

  int code = -1;
  std::thread other([&] { code = place.run("run sweep.json --json --jobs 1"); });
  while (place.run_files(".vtkhdf").size() < 3) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK_FALSE(fs::exists(folder / "run.vtkhdf"));
  owner.reset();  // as if the owner had been killed
  other.join();
  CHECK(code == 0);
  CHECK(computed(place.out_lines()) == 4);
}

TEST_CASE("plan: other processes see why a run failed", "[campaign]") {
  Workplace place;
  place.write("bad.json", R"({"name": "bad", "duration": 0.1, "mesh": {"file": "mesh.obj"}})");
  place.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
  CHECK(place.run("run bad.json") == exit_mesh);
  REQUIRE(place.run("plan bad.json") == 0);
  CHECK(place.out().find("1 failed") != std::string::npos);
  CHECK(place.out().find("mesh.obj") != std::string::npos);
  REQUIRE(place.run("plan bad.json --json") == 0);
  CHECK(place.out_lines().at(0).at("state") == "failed");
  CHECK(place.out_lines().at(0).at("reason").get<std::string>().find("mesh.obj") != std::string::npos);
}

}  // namespace bendlab::shard_test
