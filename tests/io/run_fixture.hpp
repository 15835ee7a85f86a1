// A run in which every number is known: a unit square of two triangles that rises by a metre per frame.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "tests/places.hpp"

namespace bendlab::test {

/// A new empty folder, removed at the end of the scope.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "bendlab-io-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline RunHeader square_header() {
  RunHeader header;
  header.id = "0123456789abcdef";
  header.name = "square";
  header.rest_positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  header.triangles = {0, 1, 2, 0, 2, 3};
  header.pinned = {1, 0, 0, 0};
  header.pin_seeds = {0};
  header.metrics = {{"drop", "m", "how far it hangs"}, {"energy", "J", "kinetic energy"}};
  header.cell_fields = {{"stretch", "1", "largest principal stretch"}, {"shape", "1", "shape quality"}};
  header.constraints = {{"strain", 2, "hash of strain", 0, {}, {}},
                        {"distance", 2, "hash of distance", 2, {0, 2, 1, 3}, {1.5, 2.5}},
                        {"hinge", 1, "hash of hinge", 4, {0, 2, 1, 3}, {0.5, 2, 1}, 3, {0.25}}};
  header.provenance = {{"commit", "0a1b2c3"}, {"compiler", "g++ <12> \"−O2\""}};
  header.config = "{\"name\": \"square\"}";
  return header;
}

/// In frame k, z and drop are k and the energy is k². Cell fields are 10k + t and −k. All are exact in single
/// precision.
inline Frame square_frame(int k) {
  const double z = k;
  Frame frame;
  frame.time = 0.25 * k;
  frame.positions = {0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z};
  frame.metrics = {z, z * z};
  const auto field = static_cast<float>(k);
  frame.cell_fields = {{10 * field, 10 * field + 1}, {-field, -field}};
  return frame;
}

inline RunFooter square_footer() {
  RunFooter footer;
  footer.summary = {{"drop", 0.5}, {"vertices", 4}};
  footer.passes = {{"strain", 1.5, 100}, {"gravity", 0.25, 10}};
  footer.wall_s = 3.5;
  footer.cpu_s = 7;
  footer.step_cpu_s = 5;
  footer.provenance = {{"ordering_hash", "hash of both"}};
  return footer;
}

/// Writes `frames` frames and finishes the file.
inline void write_square_run(const std::filesystem::path& path, int frames) {
  RunFileWriter writer(path, square_header());
  for (int k = 0; k < frames; ++k) writer.write(square_frame(k));
  writer.finish(square_footer());
}

/// How many committed frames of the file differ from square_frame().
inline std::size_t wrong_frames(const std::filesystem::path& path) {
  const auto times = read_metric(path, "time"), drop = read_metric(path, "drop"),
             energy = read_metric(path, "energy");
  if (drop.size() != times.size() || energy.size() != times.size()) return times.size() + 1;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Frame frame = square_frame(static_cast<int>(i));
    const bool right = times[i] == frame.time && drop[i] == frame.metrics[0] &&
                       energy[i] == frame.metrics[1] &&
                       read_positions(path, static_cast<std::int64_t>(i)) == frame.positions;
    if (!right) ++wrong;
  }
  return wrong;
}

/// Whether a new writer can take over the first frames of an unfinished run, write another frame, and finish.
inline bool goes_on_from(const std::filesystem::path& part, const std::filesystem::path& path,
                         std::uint64_t frames) try {
  RunFileWriter writer(path, square_header(), path.string() + ".new.part", {part, frames});
  writer.write(square_frame(static_cast<int>(frames)));
  RunFooter footer = square_footer();
  footer.status = RunStatus::interrupted;
  writer.finish(footer);
  return read_run(path).frames == frames + 1 && wrong_frames(path) == 0;
} catch (const RunFileError&) {
  return false;
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The text of the exception of type `Error` that `action` throws, or empty if it throws none.
template <class Error, class Action>
std::string error_text(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// Runs a Python script in which `run` is the file opened by h5py; it may use np (numpy) and json. True if
/// all its assertions hold.
inline bool h5py_accepts(const std::filesystem::path& file, const std::string& script) {
  const auto path = file.string() + ".check.py";
  std::ofstream(path) << "import json, sys, h5py, numpy as np\nrun = h5py.File(sys.argv[1], 'r')\n" << script;
  const std::string configured = places::python;
  const std::string python = configured.empty() ? "/usr/bin/python3" : configured;
  return std::system(("'" + python + "' '" + path + "' '" + file.string() + "'").c_str()) == 0;
}

}  // namespace bendlab::test
