#include "bendlab/io/run_series.hpp"

#include <fmt/ranges.h>

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

// Files of older programs have a dataset for every metric.
bool has_table(hid_t metrics) {
  return hdf5::has_link(metrics, metric_values);
}

std::vector<std::string> names_in(hid_t metrics) {
  if (!has_table(metrics)) return hdf5::links(metrics);
  std::vector<std::string> names;
  if (hdf5::has_link(metrics, "names"))
    names = hdf5::read_texts(metrics, "names");
  else if (const auto facts = read_facts(Handle(H5Iget_file_id(metrics), H5Fclose)))
    for (const Column& column : facts->metrics()) names.push_back(column.name);
  if (hdf5::shape_of(hdf5::open_dataset(metrics, metric_values)).at(1) != names.size())
    throw hdf5::Failure("its table of metrics has not a column for each name");
  return names;
}

// A text for each of that many metrics.
std::vector<std::string> texts_of(hid_t metrics, const char* what, std::size_t count) {
  std::vector<std::string> texts = hdf5::read_texts(metrics, what);
  if (texts.size() != count) throw hdf5::Failure(fmt::format("its metrics have not {} each", what));
  return texts;
}

/// Whether every dataset has frame k.
bool is_readable(hid_t file, const ParaViewShape& shape, std::uint64_t k) {
  const auto read = [&](const std::string& name, std::uint64_t rows_per_frame) {
    return hdf5::read_rows<double>(hdf5::open_dataset(file, name), k * rows_per_frame, rows_per_frame);
  };
  try {
    read("/VTKHDF/Points", shape.vertices);
    for (const auto& field : shape.cell_fields) read("/VTKHDF/CellData/" + field, shape.triangles);
    const Handle metrics = hdf5::open_group(file, "metrics");
    if (has_table(metrics))
      read("/metrics/" + std::string(metric_values), 1);
    else
      for (const auto& metric : hdf5::links(metrics)) read("/metrics/" + metric, 1);
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

Series create_cell_field(hid_t cell_data, const std::string& name, const ParaViewShape& shape) {
  return {cell_data, name, {.type = H5T_NATIVE_FLOAT, .rows = shape.triangles}};
}

Series create_metric_values(hid_t metrics, std::size_t columns) {
  return {metrics,
          metric_values,
          {.type = H5T_NATIVE_DOUBLE, .columns = columns, .frames_per_chunk = metric_rows_per_chunk}};
}

std::vector<std::string> metric_names(hid_t file) {
  return names_in(hdf5::open_group(file, "metrics"));
}

std::vector<Column> metric_columns(hid_t file) {
  const Handle metrics = hdf5::open_group(file, "metrics");
  const std::vector<std::string> names = names_in(metrics);
  std::vector<Column> columns;
  if (const auto facts = read_facts(file)) {
    columns = facts->metrics();
  } else if (has_table(metrics)) {
    const auto units = texts_of(metrics, "units", names.size()),
               meanings = texts_of(metrics, "meanings", names.size());
    for (std::size_t i = 0; i < names.size(); ++i) columns.push_back({names[i], units[i], meanings[i]});
  } else {
    for (const std::string& name : names) {
      auto texts = hdf5::read_text_attributes(hdf5::open_dataset(metrics, name));
      columns.push_back({name, texts["unit"], texts["meaning"]});
    }
  }
  return columns;
}

std::vector<double> read_metric_rows(hid_t file, const std::string& name, std::uint64_t count) {
  const Handle metrics = hdf5::open_group(file, "metrics");
  const std::vector<std::string> names = names_in(metrics);
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw hdf5::Failure(fmt::format("it has no metric '{}', but {}", name, fmt::join(names, ", ")));
  if (!has_table(metrics)) return hdf5::read_rows<double>(hdf5::open_dataset(metrics, name), 0, count);
  const auto column = static_cast<hsize_t>(found - names.begin());
  return hdf5::read_column(hdf5::open_dataset(metrics, metric_values), column, count);
}

std::vector<std::vector<double>> read_all_metrics(hid_t file, std::uint64_t count) {
  const Handle metrics = hdf5::open_group(file, "metrics");
  const std::vector<std::string> names = names_in(metrics);
  std::vector<std::vector<double>> columns(names.size());
  if (!has_table(metrics)) {
    for (std::size_t i = 0; i < names.size(); ++i) columns[i] = read_metric_rows(file, names[i], count);
    return columns;
  }
  const auto values = hdf5::read_rows<double>(hdf5::open_dataset(metrics, metric_values), 0, count);
  for (std::size_t at = 0; at < values.size(); ++at) columns[at % names.size()].push_back(values[at]);
  return columns;
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
  shape.times = read_metric_rows(file, "time", rows(metrics, has_table(metrics) ? metric_values : "time"));
  if (read_status(file) != RunStatus::running) return shape;
  // Metrics are written last, so no frame should be lost here; but a power cut may have lost pages of the
  // disk.
  while (!shape.times.empty() && !is_readable(file, shape, shape.times.size() - 1)) shape.times.pop_back();
  return shape;
}

}  // namespace bendlab
