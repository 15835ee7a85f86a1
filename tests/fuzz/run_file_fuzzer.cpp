// Files in the folder of a run: the checksum of the run file, the checkpoint, and the texts and numbers in
// the run file.
//
// The first byte, a digit, chooses the reader: see `readers`. HDF5 itself is not fuzzed. Its library crashes
// on damaged files, or never ends. Therefore a child process of the program reads files without a valid
// checksum (checked_read.hpp, tests/trust/flips.py). Files with a valid checksum were written by us. So here
// the input goes into a file that we write, and must be read back.
#include <array>
#include <cmath>
#include <cstring>
#include <memory>

#include "bendlab/io/checksum.hpp"
#include "bendlab/io/run_file.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/settings/archive.hpp"
#include "bendlab/settings/input_file.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/broken_bound.hpp"
#include "experiments/run/checkpoint.hpp"
#include "experiments/run/plausibility.hpp"
#include "experiments/run/recorder.hpp"
#include "experiments/run/run_id.hpp"
#include "experiments/run/warning.hpp"
#include "tests/fuzz/fuzzer.hpp"

using namespace bendlab;
using namespace bendlab::fuzz;

namespace {

using Bytes = std::string_view;

// Cuts values off the front of the input; at its end they are zero.
class Input {
 public:
  explicit Input(Bytes bytes) : rest_(bytes) {}

  template <class Number>
  Number number() {
    Number value{};
    const std::size_t size = std::min(sizeof value, rest_.size());
    std::memcpy(&value, rest_.data(), size);
    rest_.remove_prefix(size);
    return value;
  }
  // A text of up to 255 characters, converted to UTF-8.
  std::string text() {
    const std::string text(rest_.substr(0, number<std::uint8_t>() % 64));
    rest_.remove_prefix(std::min(text.size(), rest_.size()));
    return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  bool at_end() const { return rest_.empty(); }
  Bytes rest() const { return rest_; }

 private:
  Bytes rest_;
};

void read_seal(Bytes bytes) {
  const std::filesystem::path file = folder() / "sealed";
  write(file, bytes);
  seal_of(file);
  seal(file);
  require(seal_of(file) == Seal::whole, "a sealed file is whole");
  std::string changed = read_input_file(file);
  const std::size_t at = changed.size() * 7 / 11;
  changed[at] = static_cast<char>(changed[at] ^ 1);
  write(file, changed);
  require(seal_of(file) != Seal::whole, "a changed file is not whole");
}

void read_checkpoints(Bytes bytes) {
  constexpr const char *id = "0123456789abcdef", *name = "run.checkpoint";
  write(folder() / name, bytes);
  read_checkpoint(folder(), id);
  write(folder() / name, hex_hash(std::string(bytes)) + std::string(bytes));  // with a valid hash
  read_checkpoint(folder(), id);
  write_checkpoint(folder(), id, {bytes.size(), std::string(bytes)});
  const std::optional<Checkpoint> read = read_checkpoint(folder(), id);
  require(read && read->frames == bytes.size() && read->state == bytes, "a checkpoint is read back");
  require(!read_checkpoint(folder(), "another run"), "a checkpoint belongs to its run");
}

// A value of every type that an archive reads.
struct Everything {
  struct Part {
    std::vector<std::string> names;
    std::optional<double> since;
    void archive(Archive& state) { state(names, since); }
  };
  double number = 0;
  bool yes = false;
  std::string text;
  std::vector<double> numbers;
  std::vector<Part> parts;
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> rows;
  Eigen::MatrixXf matrix;
  Eigen::Vector3d fixed = Eigen::Vector3d::Zero();
  void archive(Archive& state) { state(number, yes, text, numbers, parts, rows, matrix, fixed); }
};

void read_archive(Bytes bytes) try {
  Everything read;
  Archive in{std::string(bytes)};
  read.archive(in);
  Archive out;
  read.archive(out);
  Everything again;
  Archive in_again(out.bytes());
  again.archive(in_again);
  require(in_again.at_end() && again.text == read.text && again.numbers.size() == read.numbers.size() &&
              again.parts.size() == read.parts.size() && again.matrix.size() == read.matrix.size(),
          "an archive writes what it read, and reads it again");
} catch (const std::runtime_error&) {  // the archive ends too early
}

// A small run with every kind of effect that keeps state between steps.
struct Run {
  RunConfig config = parse_experiment(R"({"name": "run", "mesh": {"cells": 2}, "duration": 1, "effects": [
      {"type": "gravity"}, {"type": "self_collision", "thickness": 0.1}, {"type": "plane"},
      {"type": "friction"}],
      "output": {"measures": ["stability"]}})",
                                      "run")
                         .runs.front();
  BuiltScene scene = build_scene(config.scene());
  std::unique_ptr<Simulation> simulation = simulation_of(scene);
  Recorder recorder{config, scene};
  Plausibility plausibility{scene};

  void step() {
    const bool whole = simulation->step();
    if (!whole) return;
    recorder.step(*simulation, {.is_recorded = true});
    plausibility.look(*simulation, true);
  }
  void archive(Archive& state) { state(*simulation, recorder, plausibility); }
};

// The state of a stopped run, changed at places that the input names, and cut. The run is not continued,
// because a checkpoint with a valid hash always has the right numbers.
void read_state(Bytes bytes) {
  static const std::string whole = [] {
    Run run;
    run.step();
    Archive written;
    run.archive(written);
    return written.bytes();
  }();
  std::string state = whole;
  Input input(bytes);
  const auto cut = input.number<std::uint16_t>();
  while (!input.at_end()) {
    const std::size_t at = input.number<std::uint16_t>();
    state[at % state.size()] = static_cast<char>(input.number<std::uint8_t>());
  }
  state.resize(state.size() - cut % 64 * (cut / 64 % 2));
  Run run;
  try {
    Archive read(state);
    run.archive(read);
  } catch (const std::exception&) {  // in this case step_to_end() starts the run again
  }
}

// JSON in a run file: the broken bound, the warnings and the config.
void read_texts(Bytes bytes) {
  const Json json = Json::parse(bytes, nullptr, false);
  if (const std::optional<BrokenBound> broken = broken_bound_of(json)) text_of(*broken);
  for (const Warning& warning : warnings_of(json))
    require(warnings_of(to_json({warning})).size() == 1, "a warning is read back");
  try {
    const RunConfig config = stored_run(json);
    identity_text(config.resolved());
  } catch (const std::exception&) {  // callers report this error
  }
}

void read_written(Bytes bytes) {
  Input input(bytes);
  RunHeader header{.id = input.text(), .name = input.text()};
  const auto vertices = 3 + input.number<std::uint8_t>() % 3u;
  for (std::size_t i = 0; i < 3 * vertices; ++i) header.rest_positions.push_back(input.number<float>());
  header.triangles = {0, 1, 2};
  header.pinned.assign(vertices, 0);
  header.metrics = {{"drop", "m", input.text()}};
  header.provenance = {{"message", input.text()}, {"host", input.text()}};
  header.config = Json(input.text()).dump();
  header.inputs = {{"/mesh/file", input.text(), std::string(input.rest())}};
  Frame frame{.time = input.number<double>(), .metrics = {input.number<double>()}};
  frame.positions = header.rest_positions;
  RunFooter footer{.summary = {{"drop", input.number<double>()}}, .passes = {{input.text(), 1, 2, 3}}};

  const std::filesystem::path file = folder() / "run.vtkhdf";
  const bool in_memory = bytes.size() % 2 == 0;
  RunFileWriter writer(file, header, {}, {}, in_memory ? InMemory{1 << 20, 1e6} : InMemory{});
  writer.write(frame);
  writer.finish(footer);
  const auto same = [](double a, double b) {
    return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
  };
  require(seal_of(file) == Seal::whole, "a finished file is sealed");
  const RunRecord run = read_run(file);
  require(run.id == header.id && run.name == header.name && run.config == header.config &&
              run.provenance.at("message") == header.provenance.at("message"),
          "texts are read back");
  require(run.frames == 1 && same(run.summary.at("drop"), footer.summary.at("drop")) &&
              run.passes.at(0).name == footer.passes.at(0).name,
          "the footer is read back");
  const std::vector<InputFile> inputs = read_inputs(file);
  require(inputs.size() == 1 && inputs[0].bytes == header.inputs[0].bytes &&
              inputs[0].name == header.inputs[0].name,
          "input files are read back");
  const RestRecord rest = read_rest(file);
  for (std::size_t i = 0; i < rest.positions.size(); ++i)
    require(same(rest.positions[i], header.rest_positions[i]), "positions are read back");
  require(same(read_metric(file, "drop").at(0), frame.metrics[0]), "metrics are read back");
}

constexpr std::array readers = {read_seal,  read_checkpoints, read_archive,
                                read_state, read_texts,       read_written};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return -1;
  readers[static_cast<std::uint8_t>(data[0] - '0') % readers.size()](text_of(data + 1, size - 1));
  return 0;
}
