#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "bendlab/io/checksum.hpp"
#include "bendlab/io/run_series.hpp"

namespace bendlab {
namespace {

using hdf5::Handle;
using hdf5::Series;

// A generous bound on the growth of a dataset's index per frame: 1000 entries of 16 bytes, as after 100 000
// frames.
constexpr std::uint64_t index_bytes = 16 * 1024;
constexpr std::uint64_t footer_bytes = 512 * 1024;

void write_constraints(hid_t file, const std::vector<ConstraintRecord>& records) {
  const Handle constraints = hdf5::create_group(file, "constraints");
  for (const auto& record : records) {
    const Handle group = hdf5::create_group(constraints, record.kind);
    hdf5::write_attribute(group, "count", record.count);
    hdf5::write_attribute(group, "hash", record.hash);
    if (!record.vertices.empty())
      hdf5::write_array(group, "vertices", record.vertices,
                        static_cast<hsize_t>(record.vertices_per_constraint));
    if (!record.rest.empty() && record.rest_per_constraint == 1)
      hdf5::write_array(group, "rest", record.rest);
    else if (!record.rest.empty())
      hdf5::write_array(group, "rest", record.rest, static_cast<hsize_t>(record.rest_per_constraint));
    if (!record.softness.empty()) hdf5::write_array(group, "softness", record.softness);
  }
}

void write_texts(hid_t object, const std::map<std::string, std::string>& texts) {
  for (const auto& [name, text] : texts) hdf5::write_attribute(object, name, text);
}

void write_header(hid_t file, const RunHeader& header) {
  hdf5::write_attribute(file, "id", header.id);
  hdf5::write_attribute(file, "name", header.name);
  hdf5::write_attribute(file, "status", to_string(RunStatus::running));
  const Handle rest = hdf5::create_group(file, "rest");
  hdf5::write_array(rest, "positions", header.rest_positions, 3);
  hdf5::write_array(rest, "triangles", header.triangles, 3);
  hdf5::write_array(rest, "pinned", header.pinned);
  hdf5::write_array(rest, "pin_seeds", header.pin_seeds);
  write_constraints(file, header.constraints);
  const Handle provenance = hdf5::create_group(file, "provenance");
  write_texts(provenance, header.provenance);
  hdf5::write_texts(provenance, "config", {header.config});
  if (header.inputs.empty()) return;
  const Handle inputs = hdf5::create_group(provenance, "inputs");
  for (std::size_t k = 0; k < header.inputs.size(); ++k) {
    const InputFile& input = header.inputs[k];
    const std::string name = std::to_string(k);
    hdf5::write_array(inputs, name, std::vector<std::uint8_t>(input.bytes.begin(), input.bytes.end()));
    const Handle dataset = hdf5::open_dataset(inputs, name);
    hdf5::write_attribute(dataset, "pointer", input.pointer);
    hdf5::write_attribute(dataset, "name", input.name);
  }
}

void write_footer(hid_t file, const RunFooter& footer) {
  const Handle timing = hdf5::create_group(file, "timing");
  std::vector<std::string> names;
  std::vector<double> seconds;
  std::vector<std::uint64_t> calls, acted;
  for (const auto& pass : footer.passes) {
    names.push_back(pass.name);
    seconds.push_back(pass.seconds);
    calls.push_back(pass.calls);
    acted.push_back(pass.acted);
  }
  hdf5::write_texts(timing, "pass", names);
  hdf5::write_array(timing, "seconds", seconds);
  hdf5::write_array(timing, "calls", calls);
  hdf5::write_array(timing, "acted", acted);
  hdf5::write_attribute(timing, "wall_s", footer.wall_s);
  hdf5::write_attribute(timing, "cpu_s", footer.cpu_s);
  hdf5::write_attribute(timing, "step_cpu_s", footer.step_cpu_s);
  write_texts(hdf5::open_group(file, "provenance"), footer.provenance);
  const Handle summary = hdf5::create_group(file, "summary");
  for (const auto& [name, value] : footer.summary) hdf5::write_attribute(summary, name, value);
  hdf5::write_attribute(file, "status", to_string(footer.status));
}

void require_size(const char* what, std::size_t size, std::size_t expected) {
  if (size != expected)
    throw std::invalid_argument(fmt::format("run file: {} has {} values, expected {}", what, size, expected));
}

void require_consistent(const RunHeader& header) {
  if (header.rest_positions.size() % 3 != 0 || header.triangles.size() % 3 != 0)
    throw std::invalid_argument("run file: rest positions and triangles come in threes");
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
  /// What is open during the run; closed from the last member to the first.
  struct Open {
    Handle file;
    Series points, time;
    std::vector<Series> metrics, cell_fields;
  };

  std::filesystem::path path, part;
  ParaViewShape shape;  // grows with the frames
  std::vector<std::string> metric_names;
  std::vector<float> narrow;  // positions as they are stored
  bool failed = false;
  std::optional<Open> open;

  void create(const RunHeader& header, const EarlierFrames& earlier);
  void copy_frames(const EarlierFrames& earlier);
  void append(const Frame& frame);
  std::uint64_t frame_bytes() const;
  void close(const RunFooter& footer);
  void require_matching(const Frame& frame) const;

  /// Calls an action on the file, one at a time in the process. After a failure the file is not touched
  /// again.
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
    const hdf5::Lock lock;
    open.reset();
  }
};

void RunFileWriter::Impl::create(const RunHeader& header, const EarlierFrames& earlier) {
  auto& [file, points, time, metrics, cell_fields] = *open;
  file = hdf5::create_file(part.string());
  write_header(file, header);
  const Handle vtk = create_vtkhdf(file);
  write_static_part(vtk, header);
  points = create_points(vtk, shape);
  const Handle cell_data = hdf5::create_group(vtk, "CellData");
  for (const auto& field : header.cell_fields) {
    cell_fields.push_back(create_cell_field(cell_data, field, shape));
    shape.cell_fields.push_back(field.name);
  }
  const Handle group = hdf5::create_group(file, "metrics");
  for (const auto& metric : header.metrics) {
    metrics.push_back(create_metric(group, metric));
    metric_names.push_back(metric.name);
  }
  time = create_metric(group, {"time", "s", "simulated time"});
  if (!earlier.file.empty()) copy_frames(earlier);
  hdf5::flush(file);
}

void RunFileWriter::Impl::copy_frames(const EarlierFrames& earlier) {
  auto& [file, points, time, metrics, cell_fields] = *open;
  const Handle from = open_run(earlier.file);
  const ParaViewShape old = read_shape(from);
  if (old.vertices != shape.vertices || old.triangles != shape.triangles || old.times.size() < earlier.frames)
    throw hdf5::Failure(fmt::format("'{}' has not the frames to go on from", earlier.file.string()));
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
  for (std::size_t i = 0; i < metrics.size(); ++i)
    copy(double{}, "/metrics/" + metric_names[i], metrics[i], 1);
  copy(double{}, "/metrics/time", time, 1);
  shape.times.assign(old.times.begin(), old.times.begin() + static_cast<std::ptrdiff_t>(earlier.frames));
}

void RunFileWriter::Impl::append(const Frame& frame) {
  auto& [file, points, time, metrics, cell_fields] = *open;
  hdf5::require_room(file, frame_bytes());
  if (shape.double_positions)
    points.append(frame.positions);
  else
    points.append(narrow);
  for (std::size_t i = 0; i < cell_fields.size(); ++i) cell_fields[i].append(frame.cell_fields[i]);
  for (std::size_t i = 0; i < metrics.size(); ++i) metrics[i].append(std::span(&frame.metrics[i], 1));
  // A frame counts once its time is written, and its time is written after everything else is flushed.
  hdf5::flush(file);
  time.append(std::span(&frame.time, 1));
  hdf5::flush(file);
}

std::uint64_t RunFileWriter::Impl::frame_bytes() const {
  const std::uint64_t position = 3 * (shape.double_positions ? sizeof(double) : sizeof(float));
  const std::uint64_t fields = open->cell_fields.size();
  return shape.vertices * position + fields * shape.triangles * sizeof(float) +
         (1 + fields + open->metrics.size()) * index_bytes;
}

void RunFileWriter::Impl::close(const RunFooter& footer) {
  // Steps has at most 16 numbers a frame beside its offsets of cell fields; the footer is small.
  hdf5::require_room(open->file, footer_bytes + 8 * (16 + shape.cell_fields.size()) * shape.times.size());
  write_steps(open->file, shape);
  write_footer(open->file, footer);
  hdf5::flush(open->file);
  Handle file = std::move(open->file);
  open.reset();
  file.close();
}

void RunFileWriter::Impl::require_matching(const Frame& frame) const {
  require_size("Frame::positions", frame.positions.size(), 3 * shape.vertices);
  require_size("Frame::metrics", frame.metrics.size(), open->metrics.size());
  require_size("Frame::cell_fields", frame.cell_fields.size(), open->cell_fields.size());
  for (const auto& field : frame.cell_fields) require_size("a cell field", field.size(), shape.triangles);
}

RunFileWriter::RunFileWriter(const std::filesystem::path& path, const RunHeader& header,
                             const std::filesystem::path& part, const EarlierFrames& earlier)
    : impl_(std::make_unique<Impl>()) {
  require_consistent(header);
  impl_->path = path;
  impl_->part = part.empty() ? part_path(path) : part;
  impl_->shape = {.vertices = header.rest_positions.size() / 3,
                  .triangles = header.triangles.size() / 3,
                  .times = {},
                  .cell_fields = {},
                  .double_positions = header.double_positions};
  remove_abandoned(impl_->part);
  impl_->open.emplace();
  impl_->guarded("can't begin the run file", [&] { impl_->create(header, earlier); });
}

RunFileWriter::~RunFileWriter() = default;

void RunFileWriter::write(const Frame& frame) {
  if (impl_->open) impl_->require_matching(frame);
  if (!impl_->shape.double_positions) {
    impl_->narrow.resize(frame.positions.size());
    for (std::size_t i = 0; i < frame.positions.size(); ++i)
      impl_->narrow[i] = static_cast<float>(frame.positions[i]);
  }
  const std::string what = fmt::format("can't write frame {}", impl_->shape.times.size());
  impl_->guarded(what, [&] { impl_->append(frame); });
  impl_->shape.times.push_back(frame.time);
}

void RunFileWriter::synchronise() {
  if (impl_->open) bendlab::synchronise(impl_->part);
}

void RunFileWriter::finish(const RunFooter& footer) {
  impl_->guarded("can't finish the run file", [&] { impl_->close(footer); });
  seal(impl_->part);
  write_xdmf(impl_->path, impl_->shape);
  publish(impl_->part, impl_->path);
}

}  // namespace bendlab
