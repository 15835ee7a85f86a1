// Plans and shards: every run belongs to exactly one shard, and a plan gives exactly the runs of its
// experiment.
#include "experiments/campaign/work.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <random>

#include "experiments/run/version.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"
#include "tests/io/run_fixture.hpp"

using namespace bendlab;
using namespace bendlab::test;
namespace fs = std::filesystem;

namespace {

constexpr const char* sweep =
    R"({"name": "sheet", "duration": 0.1, "mesh": {"cells": 2}, "sweep": {"/mesh/cells": [1, 2, 3, 4]}})";

}  // namespace

TEST_CASE("shards: the longest shard takes at most 4/3 of the optimum", "[campaign]") {
  // Graham (1969), Bounds on multiprocessing timing anomalies: with the longest run first, the result is
  // within 4/3 − 1/(3n) of the optimum. The optimum is at least the mean load and the longest run.
  std::mt19937 random(1);
  std::lognormal_distribution<double> seconds(0, 2);
  for (const std::size_t count : {1u, 2u, 7u, 64u}) {
    std::vector<double> expected(200);
    for (double& duration : expected) duration = seconds(random);
    const std::vector<std::size_t> shards = shards_of(expected, count);
    REQUIRE(shards.size() == expected.size());
    std::vector<double> load(count);
    for (std::size_t i = 0; i < shards.size(); ++i) load.at(shards[i]) += expected[i];
    const double sum = std::accumulate(expected.begin(), expected.end(), 0.0);
    const double at_least = std::max(sum / static_cast<double>(count), *std::ranges::max_element(expected));
    const double bound = 4.0 / 3 - 1 / (3.0 * static_cast<double>(count));
    CHECK(*std::ranges::max_element(load) <= bound * at_least * (1 + 1e-12));
    CHECK(std::abs(std::accumulate(load.begin(), load.end(), 0.0) - sum) < 1e-9 * sum);
    CHECK(shards_of(expected, count) == shards);
  }
  CHECK(shards_of({}, 3).empty());
  CHECK(shards_of({1, 2, 3}, 3) == std::vector<std::size_t>{2, 1, 0});
}

TEST_CASE("plan: workers with and without shards compute every run once", "[campaign]") {
  Workplace place;
  place.write("sweep.json", sweep);
  REQUIRE(place.run("plan sweep.json --write p.json") == 0);
  REQUIRE(place.run("status p.json") == 0);
  CHECK(place.out().find("4 runs: 4 waiting") == 0);
  CHECK(place.run("work p.json --shard 1/2 --json --jobs 1") == 0);
  CHECK(place.out_lines().size() == 4);  // its own runs, then runs that no worker has started
  REQUIRE(place.run("status p.json --json") == 0);
  for (const auto& line : place.out_lines()) CHECK(line.at("state") == "complete");
  CHECK(place.run("work p.json --json") == 0);
  CHECK(place.out_lines().empty());
  CHECK(place.err().find("0 of 4 runs computed here, 4 computed by other processes") != std::string::npos);
  REQUIRE(place.run("run sweep.json --json") == 0);  // the same runs
  for (const auto& line : place.out_lines()) CHECK(line.at("reused") == true);
}

TEST_CASE("plan: it does not change with its config, and refuses runs that would differ now", "[campaign]") {
  Workplace place;
  place.write("sweep.json", R"({"name": "sheet", "duration": 0.1, "mesh": {"file": "mesh.obj"}})");
  place.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  REQUIRE(place.run("plan sweep.json --write plans/p.json") == 0);
  place.write("sweep.json", sweep);
  CHECK(place.run("work plans/p.json --json") == 0);
  CHECK(place.out_lines().size() == 1);
  place.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
  CHECK(place.run("work plans/p.json") == 5);
  CHECK(place.err().find("sheet is a different run now, because a file that the run reads was changed") !=
        std::string::npos);

  std::string text = test::read(place.folder / "plans/p.json");
  const std::string hash(build_info().source_hash);
  const std::size_t at = text.find(hash);
  REQUIRE(at != std::string::npos);
  place.write("other.json", text.replace(at, hash.size(), "0123456789abcdef"));
  CHECK(place.run("work other.json") == 5);
  CHECK(place.err().find("it was written by another version of the program") != std::string::npos);
  CHECK(place.run("status other.json") == 0);  // reading the status is allowed

  place.write("damaged.json", R"({"bendlab_plan": 1, "runs": 3})");
  CHECK(place.run("status damaged.json") == 5);
  CHECK(place.err().find("the plan is damaged") != std::string::npos);
  CHECK(place.run("work sweep.json") == 5);
  CHECK(place.err().find("this is not a plan of bendlab") != std::string::npos);
  CHECK(place.run("work absent.json") == 5);
  for (const char* shard : {"2/2", "1", "a/b", "1/2x", "-1/2", "0/0"}) {
    CHECK(place.run(std::string("work plans/p.json --shard ") + shard) == 2);
    CHECK(place.err().find("is not of the form i/n") != std::string::npos);
  }
}

TEST_CASE("plan: other processes see why a run failed, until it succeeds", "[campaign]") {
  Workplace place;
  place.write("bad.json", R"({"name": "bad", "duration": 0.1, "mesh": {"file": "mesh.obj"}})");
  place.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
  REQUIRE(place.run("plan bad.json --write p.json") == 0);
  CHECK(place.run("work p.json") == 4);
  REQUIRE(place.run("status p.json") == 0);
  CHECK(place.out().find("1 run: 1 failed") == 0);
  CHECK(place.out().find("mesh.obj") != std::string::npos);
}

TEST_CASE("submit: the batch file has the requested options", "[campaign]") {
  Workplace place;
  place.write("sweep.json", sweep);
  REQUIRE(place.run("submit sweep.json --dry-run --tasks 3 --cpus 2 --time 10:00 --sbatch=--mem=4G") == 0);
  for (const char* line :
       {"#!/bin/bash\n", "#SBATCH --array=0-2\n", "#SBATCH --cpus-per-task=2\n", "#SBATCH --time=10:00\n",
        "#SBATCH --mem=4G\n", "#SBATCH --requeue\n", "--shard \"$SLURM_ARRAY_TASK_ID/3\" --jobs 2"}) {
    CAPTURE(line);
    CHECK(place.out().find(line) != std::string::npos);
  }
  CHECK_FALSE(fs::exists(place.folder / "results"));
  REQUIRE(place.run("submit sweep.json --dry-run --cpus 3") == 0);
  CHECK(place.out().find("#SBATCH --array=0-1\n") != std::string::npos);  // 4 runs on 2 × 3 cores
  REQUIRE(place.run("submit sweep.json --dry-run --tasks 100") == 0);
  CHECK(place.out().find("#SBATCH --array=0-3\n") != std::string::npos);  // at most one task per run
}
