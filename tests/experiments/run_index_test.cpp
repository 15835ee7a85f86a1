// The index of a folder agrees with its run files, and notices when they change.
#include "experiments/campaign/run_index.hpp"

#include <fstream>

#include "experiments/config/experiment.hpp"
#include "experiments/run/run.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"
#include "tests/io/run_fixture.hpp"

namespace bendlab::run_index_test {
using namespace bendlab::test;
namespace fs = std::filesystem;

namespace {

/// Three runs of a sweep.
std::vector<fs::path> make_runs(const fs::path& out) {
  const Experiment experiment = parse_experiment(R"({"name": "three", "description": "tab \t and \n line",
    "duration": 0.1, "mesh": {"cells": 2}, "sweep": {"/mesh/cells": [1, 2, 3]}})",
                                                 "test");
  std::vector<fs::path> files;
  for (const RunConfig& config : experiment.runs) files.push_back(execute_run(experiment, config, out).file);
  return files;
}

std::vector<RunRecord> runs_in(const fs::path& folder) {
  return read_runs(folder, [](const std::string& what) { FAIL_CHECK(what); });
}

void check_same(const RunRecord& indexed, const RunRecord& from_file) {
  CHECK(indexed.file == from_file.file);
  CHECK(indexed.id == from_file.id);
  CHECK(indexed.name == from_file.name);
  CHECK(indexed.status == from_file.status);
  CHECK(indexed.frames == from_file.frames);
  CHECK(indexed.summary == from_file.summary);
  CHECK(indexed.wall_s == from_file.wall_s);
  CHECK(indexed.cpu_s == from_file.cpu_s);
  CHECK(indexed.step_cpu_s == from_file.step_cpu_s);
  CHECK(indexed.provenance == from_file.provenance);
  CHECK(nlohmann::json::parse(indexed.config) == nlohmann::json::parse(from_file.config));
  CHECK(indexed.metrics == from_file.metrics);
  CHECK(indexed.constraints == from_file.constraints);
  REQUIRE(indexed.passes.size() == from_file.passes.size());
  for (std::size_t i = 0; i < indexed.passes.size(); ++i) {
    CHECK(indexed.passes[i].name == from_file.passes[i].name);
    CHECK(indexed.passes[i].seconds == from_file.passes[i].seconds);
    CHECK(indexed.passes[i].calls == from_file.passes[i].calls);
    CHECK(indexed.passes[i].acted == from_file.passes[i].acted);
  }
}

}  // namespace

TEST_CASE("run index: the index agrees with the files after any change", "[campaign]") {
  const TemporaryFolder folder;
  std::vector<fs::path> files = make_runs(folder / "");
  std::ranges::sort(files);
  const fs::path index = folder / "runs.index";
  const auto check_all = [&] {
    const std::vector<RunRecord> runs = runs_in(folder / "");
    REQUIRE(runs.size() == files.size());
    for (std::size_t i = 0; i < runs.size(); ++i) check_same(runs[i], read_run(files[i]));
  };
  check_all();
  REQUIRE(fs::exists(index));
  const std::string text = bytes_of(index);
  check_all();
  CHECK(bytes_of(index) == text);  // nothing changed

  SECTION("states can be read alone, and the index keeps all other data") {
    fs::remove_all(files[1].parent_path());
    files.erase(files.begin() + 1);
    const std::vector<RunRecord> states = read_runs(
        folder / "", [](const std::string& what) { FAIL_CHECK(what); }, RunDetails::state);
    REQUIRE(states.size() == files.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
      RunRecord whole = read_run(files[i]);
      whole.summary.clear(), whole.provenance.clear(), whole.config = "null";
      RunRecord state = states[i];
      CHECK(state.config.empty());
      state.config = "null";
      check_same(state, whole);
    }
    check_all();  // from the index that was written for the states
  }
  SECTION("a damaged index is not used") {
    std::string damaged = text;
    damaged[text.find("complete")] = 'C';
    std::ofstream(index) << damaged;
    check_all();
    CHECK(bytes_of(index) == text);
    fs::resize_file(index, text.size() / 2);
    check_all();
    std::ofstream(index) << "bendlab index 2\n";
    check_all();
    CHECK(bytes_of(index) == text);
  }
  SECTION("a file replaced by another file of the same size and time is read again") {
    const auto written = fs::last_write_time(files[0]);
    RunFooter footer = square_footer();
    footer.status = RunStatus::diverged;
    fs::remove(files[0]);
    RunFileWriter writer(files[0], square_header());
    writer.finish(footer);
    fs::last_write_time(files[0], written);
    check_all();
    CHECK(runs_in(folder / "")[0].status == RunStatus::diverged);
  }
  SECTION("a removed run is no longer in the index") {
    fs::remove_all(files[1].parent_path());
    files.erase(files.begin() + 1);
    check_all();
    CHECK(bytes_of(index).size() < text.size());
  }
  SECTION("runs in a copy of the folder are read") {
    fs::copy(folder / "three", folder / "four", fs::copy_options::recursive);
    files = find_run_files(folder / "");
    CHECK(files.size() == 6);
    check_all();
  }
}

TEST_CASE("run index: a damaged run is reported and does not hide other runs", "[campaign]") {
  const TemporaryFolder folder;
  const std::vector<fs::path> files = make_runs(folder / "");
  runs_in(folder / "");
  std::fstream(files[1], std::ios::in | std::ios::out | std::ios::binary).seekp(3000).put('x');
  std::vector<std::string> problems;
  const auto runs = read_runs(folder / "", [&](const std::string& what) { problems.push_back(what); });
  CHECK(runs.size() == 2);
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].find("changed") != std::string::npos);
}

}  // namespace bendlab::run_index_test
