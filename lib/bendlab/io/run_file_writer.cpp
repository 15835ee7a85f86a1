#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "bendlab/io/checksum.hpp"
#include "bendlab/io/run_series.hpp"

namespace bendlab {
namespace {

using hdf5::Handle;
using hdf5::Series;

// Most bytes that a frame adds to a dataset's index: 1000 entries of 16 bytes, enough for 100 000 frames.
constexpr std::uint64_t index_bytes = 16 * 1024;
constexpr std::uint64_t footer_bytes = 512 * 1024;
constexpr hsize_t metric_rows_per_chunk = 32;

// Whether the record has the data of each constraint, not only the number and the hash of all constraints.
bool has_arrays(const ConstraintRecord& record) {
  return !record.vertices.empty() || !record.rest.empty() || !record.softness.empty();
}

void write_arrays(hid_t group, const ConstraintRecord& record) {
  if (!record.vertices.empty())
    hdf5::write_array(group, "vertices", record.vertices,
                      static_cast<hsize_t>(record.vertices_per_constraint));
  if (!record.rest.empty() && record.rest_per_constraint == 1)
    hdf5::write_array(group, "rest", record.rest);
  else if (!record.rest.empty())
    hdf5::write_array(group, "rest", record.rest, static_cast<hsize_t>(record.rest_per_constraint));
  if (!record.softness.empty()) hdf5::write_array(group, "softness", record.softness);
}

void write_rest(hid_t file, const RunHeader& header) {
  const Handle rest = hdf5::create_group(file, "rest");
  hdf5::write_array(rest, "positions", header.rest_positions, 3);
  hdf5::write_array(rest, "triangles", header.triangles, 3);
  hdf5::write_array(rest, "pinned", header.pinned);
  hdf5::write_array(rest, "pin_seeds", header.pin_seeds);
}

// Writes all of a header except the JSON text /facts.
void write_header(hid_t file, const RunHeader& header) {
  write_rest(file, header);
  if (std::ranges::any_of(header.constraints, has_arrays)) {
    const Handle constraints = hdf5::create_group(file, "constraints");
    for (const ConstraintRecord& record : header.constraints)
      if (has_arrays(record)) write_arrays(hdf5::create_group(constraints, record.kind), record);
  }
  if (!header.obstacles.empty()) {
    const Handle obstacles = hdf5::create_group(file, "obstacles");
    for (const ObstacleRecord& record : header.obstacles) {
      const Handle obstacle = hdf5::create_group(obstacles, std::to_string(record.effect));
      if (header.double_positions)
        hdf5::write_array(obstacle, "positions", record.positions, 3);
      else
        hdf5::write_array(obstacle, "positions",
                          std::vector<float>(record.positions.begin(), record.positions.end()), 3);
      hdf5::write_array(obstacle, "triangles", record.triangles, 3);
      hdf5::write_array(obstacle, "velocity", record.velocity);
    }
  }
  if (!header.about.empty())
    hdf5::write_array(file, "about", std::vector<std::uint8_t>(header.about.begin(), header.about.end()));
  if (header.inputs.empty()) return;
  const Handle inputs = hdf5::create_group(hdf5::create_group(file, "provenance"), "inputs");
  for (std::size_t k = 0; k < header.inputs.size(); ++k) {
    const std::string& bytes = header.inputs[k].bytes;
    hdf5::write_array(inputs, std::to_string(k), std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
  }
}

// A row of /metrics/values: the time, then the metrics in the order of RunHeader::metrics.
std::vector<double> metric_row(const Frame& frame) {
  std::vector<double> row = {frame.time};
  row.insert(row.end(), frame.metrics.begin(), frame.metrics.end());
  return row;
}

// Writes all frames at once. Each dataset gets its final size.
void write_frames(hid_t file, const RunHeader& header, const std::vector<Frame>& frames) {
  constexpr auto if_small = hdf5::Compression::if_small;
  const auto joined = [&]<class T>(T, const auto& part_of) {
    std::vector<T> values;
    for (const Frame& frame : frames) {
      const auto& part = part_of(frame);
      values.insert(values.end(), part.begin(), part.end());
    }
    return values;
  };
  const auto positions = [](const Frame& frame) -> const auto& {
    return frame.positions;
  };
  const Handle vtk = hdf5::open_group(file, "VTKHDF");
  if (header.double_positions)
    hdf5::write_array(vtk, "Points", joined(double{}, positions), 3, if_small);
  else
    hdf5::write_array(vtk, "Points", joined(float{}, positions), 3, if_small);
  const Handle cell_data =
      hdf5::create_group(vtk, "CellData", static_cast<unsigned>(header.cell_fields.size()));
  for (std::size_t i = 0; i < header.cell_fields.size(); ++i) {
    const auto field = [&](const Frame& frame) -> const auto& {
      return frame.cell_fields[i];
    };
    hdf5::write_array(cell_data, header.cell_fields[i].name, joined(float{}, field), 0, if_small);
  }
  std::vector<double> values;
  for (const Frame& frame : frames) std::ranges::copy(metric_row(frame), std::back_inserter(values));
  hdf5::create_group(file, "metrics", 1);
  hdf5::write_array(file, metric_values, values, 1 + header.metrics.size(), if_small);
}

void require_size(const char* what, std::size_t size, std::size_t expected) {
  if (size != expected)
    throw std::invalid_argument(fmt::format("run file: {} has {} values, expected {}", what, size, expected));
}

void require_consistent(const RunHeader& header) {
  if (!Json::accept(header.config)) throw std::invalid_argument("run file: the config is not JSON");
  if (header.rest_positions.size() % 3 != 0 || header.triangles.size() % 3 != 0)
    throw std::invalid_argument("run file: rest_positions and triangles must have three numbers per row");
  require_size("RunHeader::pinned", header.pinned.size(), header.rest_positions.size() / 3);
  for (const auto& record : header.constraints) {
    if (!record.vertices.empty())
      require_size("ConstraintRecord::vertices", record.vertices.size(),
                   record.count * static_cast<std::size_t>(record.vertices_per_constraint));
    if (!record.rest.empty())
      require_size("ConstraintRecord::rest", record.rest.size(),
                   record.count * static_cast<std::size_t>(record.rest_per_constraint));
    if (!record.softness.empty())
      require_size("ConstraintRecord::softness", record.softness.size(), record.count);
  }
}

}  // namespace

struct RunFileWriter::Impl {
  /// The file and datasets of a run that is still going on. The destructor closes the datasets before the
  /// file.
  struct Open {
    Handle file;
    Series points, metrics;
    std::vector<Series> cell_fields;
  };

  std::filesystem::path path, part;
  ParaViewShape shape;           // grows with the frames
  std::size_t metric_count = 0;  // without the time
  std::vector<float> narrow;     // positions as float32, if stored so
  Json facts;
  bool failed = false;
  std::optional<Open> open;

  /// The header and frames while there is no file yet: to the end of a short run, or to the limits of
  /// InMemory.
  struct Kept {
    RunHeader header;
    std::vector<Frame> frames;
    std::uint64_t bytes = 0;
    InMemory limits;
    std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();
  };
  std::optional<Kept> kept;

  void begin(const RunHeader& header, const EarlierFrames& earlier);
  void begin_with_kept();
  void keep(const Frame& frame);
  void write_now(const Frame& frame);
  void write_kept(const RunFooter& footer);
  void create(const RunHeader& header, const EarlierFrames& earlier);
  void copy_frames(const EarlierFrames& earlier);
  void append(const Frame& frame);
  std::uint64_t frame_bytes() const;
  void close(const RunFooter& footer);
  void require_matching(const Frame& frame) const;

  /// Calls `action` while it holds the lock for HDF5. After a failed action, later calls throw and write
  /// nothing.
  template <class Action>
  void guarded(const std::string& what, const Action& action) {
    if (failed || !open) throw file_error(part, what, failed ? "an earlier write failed" : "it is closed", 0);
    try {
      const hdf5::Lock lock;
      action();
    } catch (const hdf5::Failure& failure) {
      failed = true;
      throw file_error(part, what, failure.what(), failure.code());
    }
  }

  ~Impl() {
    if (kept) try {
        begin_with_kept();
      } catch (...) {  // disk or memory is full, but a destructor can't report it
      }
    const hdf5::Lock lock;
    open.reset();
  }
};

void RunFileWriter::Impl::begin(const RunHeader& header, const EarlierFrames& earlier) {
  remove_abandoned(part);
  open.emplace();
  guarded("can't begin the run file", [&] { create(header, earlier); });
}

void RunFileWriter::Impl::begin_with_kept() {
  const Kept before = std::move(*kept);
  kept.reset();
  shape.times.clear();
  shape.cell_fields.clear();
  begin(before.header, {});
  for (const Frame& frame : before.frames) write_now(frame);
}

void RunFileWriter::Impl::keep(const Frame& frame) {
  kept->frames.push_back(frame);
  shape.times.push_back(frame.time);
  kept->bytes += frame.positions.size() * sizeof(double) + frame.metrics.size() * sizeof(double) +
                 frame.cell_fields.size() * shape.triangles * sizeof(float);
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - kept->begun;
  if (kept->bytes > kept->limits.bytes || waited.count() > kept->limits.seconds) begin_with_kept();
}

void RunFileWriter::Impl::write_now(const Frame& frame) {
  if (!shape.double_positions) narrow.assign(frame.positions.begin(), frame.positions.end());
  guarded(fmt::format("can't write frame {}", shape.times.size()), [&] { append(frame); });
  shape.times.push_back(frame.time);
}

void RunFileWriter::Impl::create(const RunHeader& header, const EarlierFrames& earlier) {
  auto& [file, points, metrics, cell_fields] = *open;
  file = hdf5::create_file(part.string());
  write_header(file, header);
  facts = facts_of(header);
  write_facts(file, "facts", facts);
  const Handle vtk = create_vtkhdf(file);
  write_static_part(vtk, header);
  const hid_t real = shape.double_positions ? H5T_NATIVE_DOUBLE : H5T_NATIVE_FLOAT;
  points = Series(vtk, "Points", {.type = real, .rows = shape.vertices, .columns = 3});
  const Handle cell_data = hdf5::create_group(vtk, "CellData");
  for (const auto& field : header.cell_fields) {
    cell_fields.emplace_back(cell_data, field.name,
                             Series::Layout{.type = H5T_NATIVE_FLOAT, .rows = shape.triangles});
    shape.cell_fields.push_back(field.name);
  }
  hdf5::create_group(file, "metrics");
  metrics = Series(file, metric_values,
                   {.columns = 1 + header.metrics.size(), .frames_per_chunk = metric_rows_per_chunk});
  if (!earlier.file.empty()) copy_frames(earlier);
  hdf5::flush(file);
}

void RunFileWriter::Impl::copy_frames(const EarlierFrames& earlier) {
  auto& [file, points, metrics, cell_fields] = *open;
  const Handle from = open_run(earlier.file);
  const ParaViewShape old = read_shape(from);
  if (old.vertices != shape.vertices || old.triangles != shape.triangles || old.times.size() < earlier.frames)
    throw hdf5::Failure(fmt::format("'{}' does not have the frames to go on from", earlier.file.string()));
  hdf5::require_room(file, earlier.frames * frame_bytes());
  const auto copy = [&]<class T>(T, const std::string& name, Series& to, std::uint64_t rows) {
    const Handle dataset = hdf5::open_dataset(from, name);
    for (std::uint64_t k = 0; k < earlier.frames; ++k)
      to.append(std::span<const T>(hdf5::read_rows<T>(dataset, k * rows, rows)));
  };
  if (shape.double_positions)
    copy(double{}, "/VTKHDF/Points", points, shape.vertices);
  else
    copy(float{}, "/VTKHDF/Points", points, shape.vertices);
  for (std::size_t i = 0; i < cell_fields.size(); ++i)
    copy(float{}, "/VTKHDF/CellData/" + shape.cell_fields[i], cell_fields[i], shape.triangles);
  copy(double{}, metric_values, metrics, 1);
  shape.times.assign(old.times.begin(), old.times.begin() + static_cast<std::ptrdiff_t>(earlier.frames));
}

void RunFileWriter::Impl::append(const Frame& frame) {
  auto& [file, points, metrics, cell_fields] = *open;
  hdf5::require_room(file, frame_bytes());
  if (shape.double_positions)
    points.append(frame.positions);
  else
    points.append(narrow);
  for (std::size_t i = 0; i < cell_fields.size(); ++i) cell_fields[i].append(frame.cell_fields[i]);
  // Readers count the rows of metrics as frames, so this row is written after everything else is flushed.
  hdf5::flush(file);
  metrics.append(metric_row(frame));
  hdf5::flush(file);
}

std::uint64_t RunFileWriter::Impl::frame_bytes() const {
  const std::uint64_t position = 3 * (shape.double_positions ? sizeof(double) : sizeof(float));
  const std::uint64_t fields = open->cell_fields.size();
  return shape.vertices * position + fields * shape.triangles * sizeof(float) + (2 + fields) * index_bytes +
         metric_rows_per_chunk * (1 + metric_count) * sizeof(double);
}

// Writes the whole file of a run whose frames are all in memory.
void RunFileWriter::Impl::write_kept(const RunFooter& footer) {
  remove_abandoned(part);
  try {
    const hdf5::Lock lock;
    const hdf5::SmallScope small;
    Handle file = hdf5::create_small_file(part.string());
    write_header(file, kept->header);
    write_static_part(create_vtkhdf(file), kept->header);
    write_frames(file, kept->header, kept->frames);
    write_steps(file, shape);
    facts = facts_of(kept->header);
    facts.merge_patch(facts_of(footer));
    write_facts(file, "facts", facts);
    file.close();
  } catch (const hdf5::Failure& failure) {
    throw file_error(part, "can't be written", failure.what(), failure.code());
  }
  kept.reset();
}

void RunFileWriter::Impl::close(const RunFooter& footer) {
  // The group Steps has at most 16 numbers per frame. footer_bytes is enough for the rest.
  hdf5::require_room(open->file, footer_bytes + 8 * 16 * shape.times.size());
  write_steps(open->file, shape);
  facts.merge_patch(facts_of(footer));
  write_facts(open->file, "outcome", facts);
  hdf5::flush(open->file);
  Handle file = std::move(open->file);
  open.reset();
  file.close();
}

void RunFileWriter::Impl::require_matching(const Frame& frame) const {
  const std::size_t fields = kept ? kept->header.cell_fields.size() : open->cell_fields.size();
  require_size("Frame::positions", frame.positions.size(), 3 * shape.vertices);
  require_size("Frame::metrics", frame.metrics.size(), metric_count);
  require_size("Frame::cell_fields", frame.cell_fields.size(), fields);
  for (const auto& field : frame.cell_fields) require_size("a cell field", field.size(), shape.triangles);
}

RunFileWriter::RunFileWriter(const std::filesystem::path& path, const RunHeader& header,
                             const std::filesystem::path& part, const EarlierFrames& earlier,
                             const InMemory& first)
    : impl_(std::make_unique<Impl>()) {
  require_consistent(header);
  impl_->path = path;
  impl_->part = part.empty() ? part_path(path) : part;
  impl_->metric_count = header.metrics.size();
  impl_->shape = {.vertices = header.rest_positions.size() / 3,
                  .triangles = header.triangles.size() / 3,
                  .times = {},
                  .cell_fields = {},
                  .double_positions = header.double_positions};
  if (first.seconds > 0 && earlier.file.empty()) {
    for (const Column& field : header.cell_fields) impl_->shape.cell_fields.push_back(field.name);
    impl_->kept.emplace(Impl::Kept{.header = header, .frames = {}, .limits = first});
  } else {
    impl_->begin(header, earlier);
  }
}

RunFileWriter::~RunFileWriter() = default;

void RunFileWriter::write(const Frame& frame) {
  if (impl_->kept || impl_->open) impl_->require_matching(frame);
  if (impl_->kept)
    impl_->keep(frame);
  else
    impl_->write_now(frame);
}

void RunFileWriter::synchronise() {
  if (impl_->kept) impl_->begin_with_kept();
  if (impl_->open) bendlab::synchronise(impl_->part);
}

void RunFileWriter::finish(const RunFooter& footer) {
  const bool is_small = impl_->kept.has_value();
  if (is_small)
    impl_->write_kept(footer);
  else
    impl_->guarded("can't finish the run file", [&] { impl_->close(footer); });
  seal(impl_->part);
  const bool replaces = std::filesystem::exists(impl_->path);
  publish(impl_->part, impl_->path, is_small && !replaces ? Wait::no : Wait::for_disk);
}

}  // namespace bendlab
