// The index of a folder says what its run files say, and notices when they change.
#include "experiments/campaign/run_index.hpp"

#include <fstream>

#include "experiments/config/experiment.hpp"
#include "experiments/run/run.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"
#include "tests/io/run_fixture.hpp"

using namespace bendlab;
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

void check_same(const RunRecord& one, const RunRecord& other) {
  CHECK(one.file == other.file);
  CHECK(one.id == other.id);
  CHECK(one.name == other.name);
  CHECK(one.status == other.status);
  CHECK(one.frames == other.frames);
  CHECK(one.summary == other.summary);
  CHECK(one.wall_s == other.wall_s);
  CHECK(one.cpu_s == other.cpu_s);
  CHECK(one.step_cpu_s == other.step_cpu_s);
  CHECK(one.provenance == other.provenance);
  CHECK(nlohmann::json::parse(one.config) == nlohmann::json::parse(other.config));
  CHECK(one.metrics == other.metrics);
  CHECK(one.constraints == other.constraints);
  REQUIRE(one.passes.size() == other.passes.size());
  for (std::size_t i = 0; i < one.passes.size(); ++i) {
    CHECK(one.passes[i].name == other.passes[i].name);
    CHECK(one.passes[i].seconds == other.passes[i].seconds);
    CHECK(one.passes[i].calls == other.passes[i].calls);
    CHECK(one.passes[i].acted == other.passes[i].acted);
  }
}

}  // namespace

TEST_CASE("run index: it says what the files say, however it is come by", "[campaign]") {
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
  CHECK(bytes_of(index) == text);  // nothing was new

  SECTION("states can be had without the rest, and the index keeps the rest") {
    fs::remove_all(files[1].parent_path());
    files.erase(files.begin() + 1);
    const std::vector<RunRecord> states = read_runs(
        folder / "", [](const std::string& what) { FAIL_CHECK(what); }, Part::state);
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
  SECTION("a damaged index is not believed") {
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
  SECTION("a file that was replaced by one of the same size and time is read again") {
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
  SECTION("a run that is gone is gone") {
    fs::remove_all(files[1].parent_path());
    files.erase(files.begin() + 1);
    check_all();
    CHECK(bytes_of(index).size() < text.size());
  }
  SECTION("a copy of the folder is read anew") {
    fs::copy(folder / "three", folder / "four", fs::copy_options::recursive);
    files = find_run_files(folder / "");
    CHECK(files.size() == 6);
    check_all();
  }
}

TEST_CASE("run index: a damaged run is told, and does not hide the others", "[campaign]") {
  const TemporaryFolder folder;
  const std::vector<fs::path> files = make_runs(folder / "");
  runs_in(folder / "");
  std::fstream(files[1], std::ios::in | std::ios::out | std::ios::binary).seekp(3000).put('x');
  std::vector<std::string> told;
  const auto runs = read_runs(folder / "", [&](const std::string& what) { told.push_back(what); });
  CHECK(runs.size() == 2);
  REQUIRE(told.size() == 1);
  CHECK(told[0].find("it was changed after it was written") != std::string::npos);
}
