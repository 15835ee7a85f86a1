#include "bendlab/io/run_series.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>

namespace bendlab {
namespace {

using hdf5::Handle;

std::uint64_t rows(hid_t parent, const std::string& name) {
  return hdf5::shape_of(hdf5::open_dataset(parent, name)).at(0);
}

/// Whether frame k can be read from every dataset.
bool is_readable(hid_t file, const ParaViewShape& shape, std::uint64_t k) {
  const auto read = [&](const std::string& name, std::uint64_t rows_per_frame) {
    return hdf5::read_rows<double>(hdf5::open_dataset(file, name), k * rows_per_frame, rows_per_frame);
  };
  try {
    read("/VTKHDF/Points", shape.vertices);
    for (const auto& field : shape.cell_fields) read("/VTKHDF/CellData/" + field, shape.triangles);
    read(metric_values, 1);
    return std::isfinite(shape.times.at(k));
  } catch (const hdf5::Failure&) {
    return false;
  }
}

}  // namespace

std::string to_string(RunStatus status) {
  return std::string(run_status_names.at(static_cast<std::size_t>(status)));
}

void write_facts(hid_t file, const char* name, const Json& facts) {
  const std::string text = facts.dump(-1, ' ', false, Json::error_handler_t::replace);
  hdf5::write_array(file, name, std::vector<std::uint8_t>(text.begin(), text.end()));
}

Json read_facts(hid_t file) {
  const auto read = [&](const char* name) { return Json::parse(hdf5::read_all<std::uint8_t>(file, name)); };
  try {
    if (hdf5::has_link(file, "outcome")) return read("outcome");
  } catch (const hdf5::Failure&) {  // a killed process may have left the name without the text
  } catch (const Json::exception&) {
  }
  return read("facts");
}

std::vector<Column> metric_columns(hid_t file) {
  const Json facts = read_facts(file);
  std::vector<Column> columns;
  for (const Json& name : facts.at("metrics"))
    columns.push_back({name, facts.at("units").at(columns.size()), facts.at("meanings").at(columns.size())});
  if (hdf5::shape_of(hdf5::open_dataset(file, metric_values)).at(1) != columns.size())
    throw hdf5::Failure("the table /metrics/values does not have one column for each name in /facts");
  return columns;
}

std::vector<MetricRecord> read_all_metrics(hid_t file, std::uint64_t count) {
  std::vector<MetricRecord> metrics;
  for (Column& column : metric_columns(file)) metrics.push_back({std::move(column), {}});
  const auto values = hdf5::read_rows<double>(hdf5::open_dataset(file, metric_values), 0, count);
  for (std::size_t at = 0; at < values.size(); ++at)
    metrics[at % metrics.size()].values.push_back(values[at]);
  return metrics;
}

Handle open_run(const std::filesystem::path& path) {
  Handle file;
  try {
    file = hdf5::open_file(path.string(), H5F_ACC_RDONLY);
    if (path.extension() == ".part" && hdf5::ends_before_its_bytes(file))
      file = hdf5::open_with_all_bytes(path.string());
  } catch (const hdf5::Failure& failure) {
    if (failure.code() == EWOULDBLOCK) throw hdf5::Failure("another process is writing it", EWOULDBLOCK);
    throw;
  }
  if (!hdf5::has_link(file, "facts") || !hdf5::has_link(file, "metrics") || !hdf5::has_link(file, "VTKHDF"))
    throw hdf5::Failure("it is an HDF5 file, but not a run file");
  return file;
}

ParaViewShape read_shape(hid_t file) {
  const Handle vtk = hdf5::open_group(file, "VTKHDF"), cell_data = hdf5::open_group(vtk, "CellData"),
               points = hdf5::open_dataset(vtk, "Points"), type(H5Dget_type(points), H5Tclose);
  ParaViewShape shape{.vertices = rows(file, "/rest/positions"),
                      .triangles = rows(file, "/rest/triangles"),
                      .times = {},
                      .cell_fields = hdf5::links(cell_data),
                      .double_positions = H5Tget_size(type) == sizeof(double)};
  shape.times = hdf5::read_column(hdf5::open_dataset(file, metric_values), 0, rows(file, metric_values));
  if (read_facts(file).at("status") != to_string(RunStatus::running)) return shape;
  // Every frame should be readable, because its metrics are written last. A power cut can be an exception.
  while (!shape.times.empty() && !is_readable(file, shape, shape.times.size() - 1)) shape.times.pop_back();
  return shape;
}

}  // namespace bendlab
