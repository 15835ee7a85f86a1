#include "bendlab/io/run_series.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>

namespace bendlab {
namespace {

using hdf5::Handle;
using hdf5::Series;

std::uint64_t rows(hid_t parent, const std::string& name) {
  return hdf5::shape_of(hdf5::open_dataset(parent, name)).at(0);
}

/// Whether every dataset has frame k.
bool is_readable(hid_t file, const ParaViewShape& shape, std::uint64_t k) {
  const auto read = [&](const std::string& name, std::uint64_t rows_per_frame) {
    return hdf5::read_rows<double>(hdf5::open_dataset(file, name), k * rows_per_frame, rows_per_frame);
  };
  try {
    read("/VTKHDF/Points", shape.vertices);
    for (const auto& field : shape.cell_fields) read("/VTKHDF/CellData/" + field, shape.triangles);
    for (const auto& metric : hdf5::links(hdf5::open_group(file, "metrics"))) read("/metrics/" + metric, 1);
    return std::isfinite(shape.times.at(k));
  } catch (const hdf5::Failure&) {
    return false;
  }
}

}  // namespace

std::string to_string(RunStatus status) {
  return std::string(run_status_names.at(static_cast<std::size_t>(status)));
}

RunStatus read_status(hid_t file) {
  const std::string text = hdf5::read_text_attribute(file, "status");
  const auto at = std::find(run_status_names.begin(), run_status_names.end(), text);
  if (at == run_status_names.end()) throw hdf5::Failure("its status '" + text + "' is not known");
  return static_cast<RunStatus>(at - run_status_names.begin());
}

Series create_points(hid_t vtk, const ParaViewShape& shape) {
  const hid_t real = shape.double_positions ? H5T_NATIVE_DOUBLE : H5T_NATIVE_FLOAT;
  return {vtk, "Points", {.type = real, .rows = shape.vertices, .columns = 3}};
}

Series create_cell_field(hid_t cell_data, const Column& field, const ParaViewShape& shape) {
  Series series(cell_data, field.name, {.type = H5T_NATIVE_FLOAT, .rows = shape.triangles});
  series.describe(field.unit, field.meaning);
  return series;
}

Series create_metric(hid_t metrics, const Column& metric) {
  Series series(metrics, metric.name, {.type = H5T_NATIVE_DOUBLE, .frames_per_chunk = 256});
  series.describe(metric.unit, metric.meaning);
  return series;
}

Handle open_run(const std::filesystem::path& path) {
  Handle file;
  try {
    file = hdf5::open_file(path.string(), H5F_ACC_RDONLY);
  } catch (const hdf5::Failure& failure) {
    if (failure.code() == EWOULDBLOCK) throw hdf5::Failure("another process is writing it", EWOULDBLOCK);
    throw;
  }
  if (!hdf5::has_attribute(file, "status") || !hdf5::has_link(file, "metrics") ||
      !hdf5::has_link(file, "VTKHDF"))
    throw hdf5::Failure("it is an HDF5 file, but not a run file");
  return file;
}

ParaViewShape read_shape(hid_t file) {
  const Handle vtk = hdf5::open_group(file, "VTKHDF"), cell_data = hdf5::open_group(vtk, "CellData"),
               metrics = hdf5::open_group(file, "metrics"), points = hdf5::open_dataset(vtk, "Points"),
               type(H5Dget_type(points), H5Tclose);
  ParaViewShape shape{.vertices = rows(file, "/rest/positions"),
                      .triangles = rows(file, "/rest/triangles"),
                      .times = {},
                      .cell_fields = hdf5::links(cell_data),
                      .double_positions = H5Tget_size(type) == sizeof(double)};
  const std::uint64_t frames = rows(metrics, "time");
  shape.times = hdf5::read_rows<double>(hdf5::open_dataset(metrics, "time"), 0, frames);
  if (read_status(file) != RunStatus::running) return shape;
  // Times are written last, so no frame should be lost here; but a power cut may have lost pages of the disk.
  while (!shape.times.empty() && !is_readable(file, shape, shape.times.size() - 1)) shape.times.pop_back();
  return shape;
}

}  // namespace bendlab
