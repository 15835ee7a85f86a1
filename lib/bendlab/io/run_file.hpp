// One HDF5 file per run, for bendlab and for ParaView. The group /VTKHDF (VTKHDF 2.0 PolyData with Steps) is
// for ParaView; the other groups are for bendlab.
//
//   /VTKHDF                 the run for ParaView (Points, Polygons, PointData, CellData, Steps). Points are
//                           float64 if the solver's positions are float64, or if the cloth is so far from
//                           the origin that float32 would change its edges (mesh/single_precision.hpp)
//   /rest                   positions (V, 3) m, triangles (T, 3), pinned (V), pin_seeds
//   /metrics/values         a row per recorded frame (F, C); the first column is the time
//   /constraints/<kind>     vertices, rest values and softness, only on request
//   /obstacles/<k>          the surface of effect k at time 0: positions (n, 3) m, triangles (m, 3) with
//                           normals outward, velocity (3) m/s; positions in the precision of Points
//   /about                  units and meanings of summary metrics and settings, as a compressed JSON text:
//                           {"summary": {name: [unit, meaning]}, "settings": {pointer: [unit, meaning]}}
//   /provenance/inputs/<k>  the bytes of the k-th file that the config names
//   /facts                  all other data, as a compressed JSON text. If the file grows with its run, /facts
//                           has the facts of the run's start, and /outcome has the facts of the run's end
//
// The JSON object of the facts has:
//
//   id, name, config        texts, and the resolved config
//   status                  running | complete | diverged | interrupted | implausible
//   metrics, units, meanings  names, units and meanings of the columns of /metrics/values
//   cell_fields             {name: [unit, meaning]}
//   constraints, hashes     {kind: number}, {kind: text}
//   inputs                  [[pointer, name]] of the files that the config names
//   provenance              {name: text}: commit, compiler, …. Three texts are JSON: `point`, the values of
//                           the swept settings, and `models` and `methods`, the traits of all models and
//                           methods of the program
//   summary                 {name: number}; a number that is not finite is a text: "nan", "inf", "-inf"
//   passes                  [[name, seconds, calls, acted]]
//   wall_s, cpu_s, step_cpu_s
//
// A frame is committed if its row of /metrics/values is written. This row is the last data of a frame, so the
// number of committed frames is the number of rows. After a power cut the last row may be incomplete.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bendlab {

/// A file could not be written or read. The text says which file, why, and what to do. Exit code 5.
class RunFileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The verdict on a run. `implausible`: computed to its end, but it broke a bound that is true for its scene.
enum class RunStatus { running, complete, diverged, interrupted, implausible };
inline constexpr std::array<std::string_view, 5> run_status_names = {"running", "complete", "diverged",
                                                                     "interrupted", "implausible"};
std::string to_string(RunStatus status);

/// Whether the run was computed to its end: complete or implausible.
inline bool is_whole(RunStatus status) {
  return status == RunStatus::complete || status == RunStatus::implausible;
}
/// Whether repeating the run would give the same result: the run is whole or diverged.
inline bool is_over(RunStatus status) {
  return is_whole(status) || status == RunStatus::diverged;
}

struct Column {
  std::string name, unit, meaning;
};

struct ConstraintRecord {
  std::string kind;  ///< "strain", "distance", …
  std::uint64_t count = 0;
  std::string hash;                 ///< of vertices, rest values and softness in solver order
  int vertices_per_constraint = 0;  ///< columns of `vertices`
  std::vector<int> vertices;        ///< #C by vertices_per_constraint, row by row; empty unless recorded
  std::vector<double> rest;         ///< #C by rest_per_constraint, row by row; empty unless recorded
  int rest_per_constraint = 1;      ///< columns of `rest`
  std::vector<double> softness;     ///< #C, factors of the scene's compliance; empty if not recorded or 1
};

/// A file that the config names, with its content.
struct InputFile {
  std::string pointer;  ///< of the setting that names the file
  std::string name;     ///< as written in the config
  std::string bytes;
};

/// The surface of an obstacle at time 0.
struct ObstacleRecord {
  std::size_t effect = 0;         ///< index in /effects
  std::vector<double> positions;  ///< 3n, m
  std::vector<int> triangles;     ///< 3m, normals outward
  std::vector<double> velocity;   ///< 3, m/s
};

/// The part of a run that is known before its first step.
struct RunHeader {
  std::string id, name;
  std::vector<double> rest_positions;  ///< 3V, m
  std::vector<int> triangles;          ///< 3T
  std::vector<std::uint8_t> pinned;    ///< V
  std::vector<int> pin_seeds;
  std::vector<Column> metrics;      ///< one per value of Frame::metrics; `time` is added by the writer
  std::vector<Column> cell_fields;  ///< one per field of Frame::cell_fields
  std::vector<ConstraintRecord> constraints;
  std::vector<ObstacleRecord> obstacles;
  std::map<std::string, std::string> provenance;  ///< attribute → text
  std::vector<InputFile> inputs;
  std::string config;             ///< resolved config as JSON text
  std::string about;              ///< units and meanings as JSON text, see above; may be empty
  bool double_positions = false;  ///< store positions as float64 instead of float32
};

struct Frame {
  double time = 0;                              ///< s
  std::vector<double> positions;                ///< 3V, m
  std::vector<double> metrics;                  ///< one per RunHeader::metrics
  std::vector<std::vector<float>> cell_fields;  ///< per RunHeader::cell_fields, T values
};

struct PassTime {
  std::string name;
  double seconds = 0;
  std::uint64_t calls = 0;
  std::uint64_t acted = 0;  ///< number of changes by its calls (vertices, pairs …); effects only
};

struct RunFooter {
  RunStatus status = RunStatus::complete;
  std::map<std::string, double> summary;
  std::vector<PassTime> passes;
  double wall_s = 0, cpu_s = 0;
  double step_cpu_s = 0;                          ///< of the steps alone, without set-up and recording
  std::map<std::string, std::string> provenance;  ///< added to the header's
};

/// Frames of an earlier file of the same run, with which a new file begins.
struct EarlierFrames {
  std::filesystem::path file;  ///< empty if there are no earlier frames
  std::uint64_t frames = 0;
};

/// How much of a run is in memory before its file is begun. A run that ends earlier writes its whole file at
/// once, which takes less time and space. In a crash, at most this part of a run is lost.
struct InMemory {
  std::uint64_t bytes = 0;  ///< of frames
  double seconds = 0;       ///< of wall time; 0: the file is begun before the first frame
};

/// Writes `part`, by default `<path>.part`, which finish() seals (checksum.hpp) and renames to `path`. After
/// a crash, the .part file has all frames whose write() returned. Writers in several threads write one frame
/// at a time. The folder has to exist. Throws RunFileError if the disk fails or another writer has `part`
/// open. Throws std::invalid_argument if sizes don't match the header, or if the config is not JSON. The file
/// is begun when the amount `first` is in memory, or by synchronise(), finish() or the destructor.
class RunFileWriter {
 public:
  RunFileWriter(const std::filesystem::path& path, const RunHeader& header,
                const std::filesystem::path& part = {}, const EarlierFrames& earlier = {},
                const InMemory& first = {});
  ~RunFileWriter();  ///< closes the file; without finish() it has the suffix .part
  RunFileWriter(const RunFileWriter&) = delete;
  RunFileWriter& operator=(const RunFileWriter&) = delete;

  void write(const Frame& frame);
  /// Waits until the frames are on the disk, so that they survive a power cut.
  void synchronise();
  /// Writes Steps, footer and checksum, waits for the disk and renames the file. If the whole run was in
  /// memory until now and the file replaces no other file, the function does not wait: if a power cut damages
  /// the file, its checksum shows the damage, and computing the run again takes little time.
  void finish(const RunFooter& footer);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Files of unfinished runs in a folder (run.vtkhdf….part), sorted. The folder may be missing.
std::vector<std::filesystem::path> unfinished_files(const std::filesystem::path& folder);

/// A run without its frames, read from a finished file or from a .part file.
struct RunRecord {
  std::filesystem::path file;
  std::string id, name;
  RunStatus status = RunStatus::running;
  std::uint64_t frames = 0;
  std::map<std::string, double> summary;
  std::vector<PassTime> passes;
  double wall_s = 0, cpu_s = 0, step_cpu_s = 0;
  std::map<std::string, std::string> provenance;
  std::string config;
  std::vector<std::string> metrics;                  ///< names, `time` among them
  std::map<std::string, std::uint64_t> constraints;  ///< kind → how many
};

RunRecord read_run(const std::filesystem::path& file);

/// The rest state of a run, as in RunHeader.
struct RestRecord {
  std::vector<double> positions;     ///< 3V, m
  std::vector<int> triangles;        ///< 3T
  std::vector<std::uint8_t> pinned;  ///< V
  std::vector<int> pin_seeds;
  bool double_positions = false;  ///< whether frames have float64 positions
};

RestRecord read_rest(const std::filesystem::path& file);

/// The files that the run's config names, with their content at the time of the run.
std::vector<InputFile> read_inputs(const std::filesystem::path& file);

/// The values of a metric, one per committed frame.
std::vector<double> read_metric(const std::filesystem::path& file, const std::string& name);

/// A metric with its values, one per committed frame.
struct MetricRecord {
  Column column;
  std::vector<double> values;
};

/// All metrics: `time` first, the other metrics sorted by name.
std::vector<MetricRecord> read_metrics(const std::filesystem::path& file);

/// Positions (3V) of the committed frame `frame`. Negative numbers count from the end: -1 is the last frame.
std::vector<double> read_positions(const std::filesystem::path& file, std::int64_t frame);

/// An XDMF text of `frames`, for programs that cannot read VTKHDF with time (ParaView before 5.12). `as_seen`
/// is the run file's path, relative to the folder of the .xdmf file. Throws RunFileError.
std::string xdmf_of(const std::filesystem::path& run_file, const std::string& as_seen,
                    std::span<const std::int64_t> frames);

/// Version of the HDF5 library.
std::string hdf5_version();

/// Compares two run files. Returns the names of datasets, metrics of the summary and the verdict if their
/// bits differ. Computing times and provenance are not compared.
std::vector<std::string> differing_parts(const std::filesystem::path& first,
                                         const std::filesystem::path& second);

}  // namespace bendlab
