// Run files are read back by us and by h5py. Bad paths and files are refused with a clear message.
#include "bendlab/io/run_file.hpp"
#include "bendlab/io/checksum.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <fstream>
#include <thread>

#include "experiments/config/experiment.hpp"
#include "experiments/run/run.hpp"
#include "tests/catch.hpp"
#include "tests/io/run_fixture.hpp"

using namespace bendlab::test;
using Catch::Matchers::WithinRel;
namespace fs = std::filesystem;

#if __has_include(<catch2/catch_test_macros.hpp>)
using Catch::Matchers::ContainsSubstring;
#else
namespace {
auto ContainsSubstring(const std::string& text) {
  return Catch::Matchers::Contains(text);
}
}  // namespace
#endif

namespace bendlab::run_file_test {
TEST_CASE("run file: everything written is read back", "[io]") {
  const TemporaryFolder folder;
  const auto path = folder / "run.vtkhdf";
  write_square_run(path, 3);

  CHECK_FALSE(fs::exists(folder / "run.vtkhdf.part"));
  const RunRecord run = read_run(path);
  CHECK(run.file == path);
  CHECK(run.id == "0123456789abcdef");
  CHECK(run.name == "square");
  CHECK(run.status == RunStatus::complete);
  CHECK(run.frames == 3);
  CHECK(run.summary == square_footer().summary);
  CHECK(run.wall_s == 3.5);
  CHECK(run.cpu_s == 7);
  CHECK(run.step_cpu_s == 5);
  CHECK(run.config == R"({"name":"square"})");
  CHECK(run.provenance == std::map<std::string, std::string>{{"commit", "0a1b2c3"},
                                                             {"compiler", "g++ <12> \"−O2\""},
                                                             {"ordering_hash", "hash of both"}});
  REQUIRE(run.passes.size() == 2);
  CHECK(run.passes[0].name == "strain");
  CHECK(run.passes[0].seconds == 1.5);
  CHECK(run.passes[1].calls == 10);

  CHECK(read_metric(path, "time") == std::vector<double>{0, 0.25, 0.5});
  CHECK(read_metric(path, "energy") == std::vector<double>{0, 1, 4});
  CHECK(read_positions(path, 1) == square_frame(1).positions);
  CHECK(read_positions(path, -1) == square_frame(2).positions);
  CHECK(read_positions(path, -3) == square_frame(0).positions);
}

TEST_CASE("run file: positions have the requested precision", "[io]") {
  const TemporaryFolder folder;
  const bool wide = GENERATE(false, true);
  auto header = square_header();
  header.double_positions = wide;
  Frame frame = square_frame(0);
  frame.positions[4] = 0.1;
  RunFileWriter writer(folder / "run.vtkhdf", header);
  writer.write(frame);
  writer.finish({});
  const double stored = read_positions(folder / "run.vtkhdf", 0)[4];
  CHECK_THAT(stored, WithinRel(0.1, 0x1p-24));  // half a unit in the last place of a float
  CHECK((stored == 0.1) == wide);
}

TEST_CASE("run file: the rest state is read back", "[io]") {
  const TemporaryFolder folder;
  const RunHeader header = square_header();
  RunFileWriter(folder / "run.vtkhdf", header).finish({});
  const RestRecord rest = read_rest(folder / "run.vtkhdf");
  CHECK(rest.positions == header.rest_positions);
  CHECK(rest.triangles == header.triangles);
  CHECK(rest.pinned == header.pinned);
  CHECK(rest.pin_seeds == header.pin_seeds);
}

TEST_CASE("run file: every status is read back, and a run may be empty", "[io]") {
  const TemporaryFolder folder;
  for (const auto status :
       {RunStatus::complete, RunStatus::diverged, RunStatus::interrupted, RunStatus::implausible}) {
    const auto path = folder / (to_string(status) + ".vtkhdf");
    RunFooter footer;
    footer.status = status;
    RunFileWriter(path, square_header()).finish(footer);
    CHECK(read_run(path).status == status);
    CHECK(read_run(path).frames == 0);
    CHECK(read_metric(path, "time").empty());
  }
}

TEST_CASE("run file: h5py finds the documented shapes", "[io]") {
  const TemporaryFolder folder;
  const auto path = folder / "run.vtkhdf";
  write_square_run(path, 3);
  CHECK(h5py_accepts(path, R"(
vtk = run['VTKHDF']
kind = vtk.attrs.get_id('Type').get_type()
assert not kind.is_variable_str() and kind.get_cset() == h5py.h5t.CSET_ASCII and kind.get_size() == 8
assert vtk.attrs['Type'] == b'PolyData'
assert vtk.attrs['Version'].dtype == np.int64 and list(vtk.attrs['Version']) == [2, 0]
assert vtk['Points'].shape == (3 * 4, 3) and vtk['Points'].dtype == np.float32
assert vtk['Points'].chunks == (4, 3) and np.isnan(vtk['Points'].fillvalue)
assert list(vtk['Points'][:, 2]) == [0] * 4 + [1] * 4 + [2] * 4
assert list(vtk['NumberOfPoints']) == [4]
assert list(vtk['Polygons/NumberOfCells']) == [2] and list(vtk['Polygons/NumberOfConnectivityIds']) == [6]
assert list(vtk['Polygons/Offsets']) == [0, 3, 6] and list(vtk['Polygons/Connectivity']) == [0, 1, 2, 0, 2, 3]
for absent in 'Vertices', 'Lines', 'Strips':
    cells = vtk[absent]
    assert list(cells['NumberOfCells']) == [0] and list(cells['NumberOfConnectivityIds']) == [0]
    assert list(cells['Offsets']) == [0] and cells['Connectivity'].shape == (0,)
assert list(vtk['CellData/stretch']) == [0, 1, 10, 11, 20, 21]
assert list(vtk['CellData/shape']) == [0, 0, -1, -1, -2, -2]
assert list(vtk['PointData/pinned']) == [1, 0, 0, 0]
steps = vtk['Steps']
assert steps.attrs['NSteps'] == 3 and list(steps['Values']) == [0, 0.25, 0.5]
assert list(steps['PartOffsets']) == [0, 0, 0] and list(steps['NumberOfParts']) == [1, 1, 1]
assert list(steps['PointOffsets']) == [0, 4, 8]
for name in 'CellOffsets', 'ConnectivityIdOffsets':
    assert steps[name].shape == (3, 4) and not steps[name][:].any()
assert list(steps['CellDataOffsets/stretch']) == [0, 2, 4]
assert list(steps['CellDataOffsets/shape']) == [0, 2, 4]
assert list(steps['PointDataOffsets/pinned']) == [0, 0, 0]
assert run['metrics/values'][:].tolist() == [[0, 0, 0], [0.25, 1, 1], [0.5, 2, 4]]
assert run['rest/positions'].shape == (4, 3) and run['rest/triangles'].shape == (2, 3)
assert list(run['rest/pin_seeds']) == [0]
assert 'constraints/strain' not in run
assert run['constraints/distance/vertices'][:].tolist() == [[0, 2], [1, 3]]
assert list(run['constraints/distance/rest']) == [1.5, 2.5] and 'softness' not in run['constraints/distance']
assert run['constraints/hinge/rest'][:].tolist() == [[0.5, 2, 1]]
assert list(run['constraints/hinge/softness']) == [0.25]
about = {
    'id': '0123456789abcdef', 'name': 'square', 'status': 'running', 'config': {'name': 'square'},
    'provenance': {'commit': '0a1b2c3', 'compiler': 'g++ <12> "−O2"'}, 'inputs': [],
    'constraints': {'strain': 2, 'distance': 2, 'hinge': 1},
    'hashes': {'strain': 'hash of strain', 'distance': 'hash of distance', 'hinge': 'hash of hinge'},
    'cell_fields': {'stretch': ['1', 'largest principal stretch'], 'shape': ['1', 'shape quality']},
    'metrics': ['time', 'drop', 'energy'], 'units': ['s', 'm', 'J'],
    'meanings': ['simulated time', 'how far it hangs', 'kinetic energy'],
    'summary': {}, 'passes': [], 'wall_s': 0, 'cpu_s': 0, 'step_cpu_s': 0}
loaded = lambda name: json.loads(run[name][()].tobytes())
assert loaded('facts') == about
about['provenance']['ordering_hash'] = 'hash of both'
assert loaded('outcome') == about | {
    'status': 'complete', 'summary': {'drop': 0.5, 'vertices': 4}, 'wall_s': 3.5, 'cpu_s': 7, 'step_cpu_s': 5,
    'passes': [['strain', 1.5, 100, 0], ['gravity', 0.25, 10, 0]]}
)"));
}

TEST_CASE("run file: the xdmf text selects the rows of each frame", "[io]") {
  const TemporaryFolder folder;
  write_square_run(folder / "a & b.vtkhdf", 3);
  const std::string text =
      xdmf_of(folder / "a & b.vtkhdf", "a & b.vtkhdf", std::array<std::int64_t, 2>{1, 2});
  CHECK_THAT(text, ContainsSubstring("a &amp; b.vtkhdf:/VTKHDF/Points"));
  CHECK_THAT(text, ContainsSubstring("<Time Value=\"0.25\"/>"));
  CHECK_THAT(text, ContainsSubstring(">8 0 1 1 4 3<"));  // points of frame 2: rows 8 to 11 of 12
  CHECK_THAT(text, ContainsSubstring(">4 1 2<"));        // cells of frame 2: values 4 and 5 of 6
}

TEST_CASE("run file: equal runs give equal bytes", "[io]") {
  const TemporaryFolder folder;
  write_square_run(folder / "a.vtkhdf", 300);  // more than a chunk of metrics and a node of a chunk index
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5's time stamps count seconds
  write_square_run(folder / "b.vtkhdf", 300);
  CHECK(bytes_of(folder / "a.vtkhdf") == bytes_of(folder / "b.vtkhdf"));
}

TEST_CASE("run file: an unfinished run is read up to its last frame", "[io]") {
  const TemporaryFolder folder;
  const auto path = folder / "run.vtkhdf", part = folder / "run.vtkhdf.part";
  {
    RunFileWriter writer(path, square_header());
    for (int k = 0; k < 5; ++k) writer.write(square_frame(k));
    CHECK(read_run(part).frames == 5);  // also while the file is open
  }
  CHECK(read_run(part).status == RunStatus::running);
  CHECK(read_run(part).frames == 5);
  CHECK(wrong_frames(part) == 0);
  CHECK_THAT(error_text<RunFileError>([&] { read_run(path); }),
             ContainsSubstring("unfinished") && ContainsSubstring("run.vtkhdf.part"));

  CHECK_FALSE(goes_on_from(part, path, 6));
  CHECK(goes_on_from(part, path, 5));
  CHECK(read_run(path).status == RunStatus::interrupted);
  CHECK(wrong_frames(path) == 0);
}

TEST_CASE("run file: a writer locks its file against other writers", "[io]") {
  const TemporaryFolder folder;
  RunFileWriter writer(folder / "run.vtkhdf", square_header());
  writer.write(square_frame(0));
  const auto again = [&] { RunFileWriter(folder / "run.vtkhdf", square_header()); };
  CHECK_THAT(error_text<RunFileError>(again), ContainsSubstring("another writer"));
  writer.write(square_frame(1));
  writer.finish({});
  CHECK(wrong_frames(folder / "run.vtkhdf") == 0);
  CHECK(read_run(folder / "run.vtkhdf").frames == 2);
}

TEST_CASE("run file: the file of a short run has the same data in less than half the space", "[io]") {
  constexpr InMemory second{.bytes = 1 << 20, .seconds = 100};
  const TemporaryFolder folder;
  const auto growing = folder / "growing.vtkhdf", small = folder / "small.vtkhdf";
  const int frames = GENERATE(0, 1, 3, 700);  // with 700 rows arrays are compressed
  write_square_run(growing, frames);
  {
    RunFileWriter writer(small, square_header(), {}, {}, second);
    for (int k = 0; k < frames; ++k) writer.write(square_frame(k));
    CHECK_FALSE(fs::exists(folder / "small.vtkhdf.part"));
    writer.finish(square_footer());
  }
  CHECK(seal_of(small) == Seal::whole);
  CHECK(differing_parts(growing, small).empty());
  CHECK(differing_parts(small, growing).empty());
  CHECK(wrong_frames(small) == 0);
  CHECK(read_run(small).summary == read_run(growing).summary);
  CHECK(read_run(small).provenance == read_run(growing).provenance);
  CHECK(read_run(small).config == read_run(growing).config);
  CHECK(read_run(small).constraints == read_run(growing).constraints);
  CHECK(read_run(small).metrics == read_run(growing).metrics);
  CHECK(read_run(small).passes.size() == 2);
  CHECK(read_run(small).passes.at(0).seconds == 1.5);
  CHECK(read_run(small).passes.at(1).calls == 10);
  CHECK(read_run(small).step_cpu_s == 5);
  if (frames == 3) CHECK(fs::file_size(small) * 2 < fs::file_size(growing));
  CHECK(h5py_accepts(small, R"(
other = h5py.File(sys.argv[1].replace('small', 'growing'))
names = []
run.visit(names.append)
theirs = []
other.visit(theirs.append)
assert set(names) == set(theirs) - {'outcome'}
for name in set(names) - {'facts'}:
    if isinstance(run[name], h5py.Dataset):
        assert run[name].dtype == other[name].dtype and np.array_equal(run[name][()], other[name][()]), name
for name in 'VTKHDF', 'VTKHDF/Steps':
    values = [{key: str(value) for key, value in file[name].attrs.items()} for file in (run, other)]
    assert values[0] == values[1], name
loaded = lambda data: json.loads(data[()].tobytes())
assert loaded(run['facts']) == loaded(other['outcome'])
)"));
}

// A study of a thousand runs with a few frames has a thousand files. Such a file has about 3.6 KB of facts,
// which are texts of the config, the build and the machine and therefore do not count here, 3.5 KB of units
// and meanings, 0.4 KB of numbers, 2.3 KB of frames and rest pose, and 5.4 KB of headers for groups and
// datasets, most of which ParaView needs.
TEST_CASE("run file: a run of 4 x 4 cells and four frames takes less than 12 KB without its facts", "[io]") {
  const TemporaryFolder folder;
  const Experiment experiment = parse_experiment(
      R"({"name": "tiny", "duration": 0.1, "mesh": {"cells": 4}, "bending": {"model": "crossover"}})",
      "tiny");
  const RunOutcome outcome = execute_run(experiment, experiment.runs.front(), folder / "", {});
  CHECK(read_run(outcome.file).frames == 4);
  CHECK(h5py_accepts(outcome.file, R"(
import os
assert os.path.getsize(sys.argv[1]) - run['facts'].id.get_storage_size() < 12000
)"));
}

TEST_CASE("run file: the file of a short run contains the files that its config names", "[io]") {
  const TemporaryFolder folder;
  const auto path = folder / "run.vtkhdf";
  RunHeader header = square_header();
  header.inputs = {{"/mesh/file", "a.obj", "v 0 0 0\n"},
                   {"/effects/0/file", "b.obj", std::string(5000, 'v')}};
  RunFileWriter(path, header, {}, {}, {.bytes = 1 << 20, .seconds = 100}).finish(square_footer());
  const std::vector<InputFile> inputs = read_inputs(path);
  REQUIRE(inputs.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(inputs[i].pointer == header.inputs[i].pointer);
    CHECK(inputs[i].name == header.inputs[i].name);
    CHECK(inputs[i].bytes == header.inputs[i].bytes);
  }
}

TEST_CASE("run file: frames kept in memory go to the file at a limit, or when the writer ends", "[io]") {
  const TemporaryFolder folder;
  const auto path = folder / "run.vtkhdf", part = folder / "run.vtkhdf.part";
  const InMemory limits = GENERATE(InMemory{.bytes = 300, .seconds = 100},  // two frames of 128 bytes
                                   InMemory{.bytes = 1 << 20, .seconds = 1e-9});
  {
    RunFileWriter writer(path, square_header(), {}, {}, limits);
    for (int k = 0; k < 3; ++k) writer.write(square_frame(k));
    CHECK(read_run(part).frames == 3);
    writer.write(square_frame(3));
    CHECK(read_run(part).frames == 4);
  }
  CHECK(wrong_frames(part) == 0);
  fs::remove(part);
  {
    RunFileWriter writer(path, square_header(), {}, {}, {.bytes = 1 << 20, .seconds = 100});
    writer.write(square_frame(0));
    writer.synchronise();
    CHECK(read_run(part).frames == 1);
    writer.write(square_frame(1));
    writer.finish(square_footer());
  }
  CHECK(wrong_frames(path) == 0);
  {
    RunFileWriter writer(path, square_header(), {}, {}, {.bytes = 1 << 20, .seconds = 100});
    writer.write(square_frame(0));
  }
  CHECK(read_run(part).frames == 1);
  CHECK(goes_on_from(part, path, 1));
}

TEST_CASE("run file: two threads can write two files", "[io]") {
  const TemporaryFolder folder;
  std::vector<std::thread> threads;
  for (const char* name : {"a.vtkhdf", "b.vtkhdf"})
    threads.emplace_back([&folder, name] { write_square_run(folder / name, 100); });
  for (auto& thread : threads) thread.join();
  for (const char* name : {"a.vtkhdf", "b.vtkhdf"}) {
    CHECK(read_run(folder / name).frames == 100);
    CHECK(wrong_frames(folder / name) == 0);
  }
}

TEST_CASE("run file: bad folders are refused with the reason of the system and advice", "[io]") {
  const TemporaryFolder folder;
  const auto refusal = [](const fs::path& path) {
    return error_text<RunFileError>([&] { RunFileWriter(path, square_header()); });
  };
  const auto absent = folder / "absent" / "run.vtkhdf";
  CHECK_THAT(refusal(absent),
             ContainsSubstring(absent.string() + ".part: can't begin the run file: No such file or") &&
                 ContainsSubstring("its folder must exist"));
  std::ofstream(folder / "file") << "text";
  CHECK_THAT(refusal(folder / "file" / "run.vtkhdf"), ContainsSubstring("Not a directory"));
  if (geteuid() == 0) return;  // root may write anywhere
  REQUIRE(chmod((folder / "").c_str(), 0500) == 0);
  CHECK_THAT(refusal(folder / "run.vtkhdf"),
             ContainsSubstring("Permission denied") && ContainsSubstring("folder in which you may write"));
  REQUIRE(chmod((folder / "").c_str(), 0700) == 0);
}

TEST_CASE("run file: files that are no run files are refused", "[io]") {
  const TemporaryFolder folder;
  const auto refusal = [](const fs::path& path) { return error_text<RunFileError>([&] { read_run(path); }); };
  CHECK_THAT(refusal(folder / "absent.vtkhdf"), ContainsSubstring("No such file"));
  std::ofstream(folder / "text.vtkhdf") << "no run";
  CHECK_THAT(refusal(folder / "text.vtkhdf"), ContainsSubstring("can't be read as a run file"));

  const auto path = folder / "run.vtkhdf";
  write_square_run(path, 3);
  REQUIRE(h5py_accepts(path, "h5py.File(sys.argv[1] + '.other', 'w').create_group('metrics')\n"));
  CHECK_THAT(refusal(folder / "run.vtkhdf.other"), ContainsSubstring("an HDF5 file, but not a run file"));
  fs::copy(path, folder / "cut.vtkhdf");
  fs::resize_file(folder / "cut.vtkhdf", 2000);
  CHECK_THAT(refusal(folder / "cut.vtkhdf"), ContainsSubstring("can't be read as a run file"));

  CHECK_THAT(error_text<RunFileError>([&] { read_metric(path, "dorp"); }),
             ContainsSubstring("'dorp', only time, drop, energy"));
  CHECK_THAT(error_text<RunFileError>([&] { read_positions(path, 3); }), ContainsSubstring("frame 3"));
  CHECK_THAT(error_text<RunFileError>([&] { read_positions(path, -4); }), ContainsSubstring("no frame -4"));
}

TEST_CASE("run file: a frame of the wrong size is a programming error", "[io]") {
  const TemporaryFolder folder;
  RunFileWriter writer(folder / "run.vtkhdf", square_header());
  Frame frame = square_frame(0);
  frame.metrics.pop_back();
  CHECK_THROWS_AS(writer.write(frame), std::invalid_argument);
  frame = square_frame(0);
  frame.cell_fields[1].push_back(0);
  CHECK_THROWS_AS(writer.write(frame), std::invalid_argument);
  writer.write(square_frame(0));
  writer.finish({});
  CHECK(read_run(folder / "run.vtkhdf").frames == 1);
}

}  // namespace bendlab::run_file_test
