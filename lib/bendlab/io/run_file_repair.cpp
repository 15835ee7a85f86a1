// An interrupted run is not repaired in place: its committed frames are copied, and the .part file stays
// until the copy is on the disk.
#include "bendlab/io/run_series.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;
using hdf5::Handle;
using hdf5::Series;

void copy(hid_t from, hid_t to, const char* name) {
  hdf5::check(H5Ocopy(from, name, to, name, H5P_DEFAULT, H5P_DEFAULT));
}

template <class T>
void copy_frames(hid_t from, Series& to, std::uint64_t rows, std::size_t frames) {
  for (std::size_t k = 0; k < frames; ++k)
    to.append(std::span<const T>(hdf5::read_rows<T>(from, k * rows, rows)));
}

Column describe(hid_t dataset, const std::string& name) {
  return {name, hdf5::read_text_attribute(dataset, "unit"), hdf5::read_text_attribute(dataset, "meaning")};
}

void copy_vtkhdf(hid_t from, hid_t to, const ParaViewShape& shape) {
  const std::size_t frames = shape.times.size();
  const Handle old_vtk = hdf5::open_group(from, "VTKHDF"), vtk = create_vtkhdf(to);
  for (const char* name : static_part) copy(old_vtk, vtk, name);
  Series points = create_points(vtk, shape);
  const Handle old_points = hdf5::open_dataset(old_vtk, "Points");
  if (shape.double_positions)
    copy_frames<double>(old_points, points, shape.vertices, frames);
  else
    copy_frames<float>(old_points, points, shape.vertices, frames);
  const Handle old_data = hdf5::open_group(old_vtk, "CellData"), data = hdf5::create_group(vtk, "CellData");
  for (const auto& field : shape.cell_fields) {
    const Handle old_field = hdf5::open_dataset(old_data, field);
    Series series = create_cell_field(data, describe(old_field, field), shape);
    copy_frames<float>(old_field, series, shape.triangles, frames);
  }
}

void copy_metrics(hid_t from, hid_t to, std::size_t frames) {
  const Handle old_metrics = hdf5::open_group(from, "metrics"), metrics = hdf5::create_group(to, "metrics");
  for (const auto& metric : hdf5::links(old_metrics)) {
    const Handle old_metric = hdf5::open_dataset(old_metrics, metric);
    Series series = create_metric(metrics, describe(old_metric, metric));
    copy_frames<double>(old_metric, series, 1, frames);
  }
}

void copy_run(hid_t from, hid_t to, const ParaViewShape& shape) {
  for (const char* name : {"id", "name"})
    hdf5::write_attribute(to, name, hdf5::read_text_attribute(from, name));
  // A run that was stopped between its footer and the rename keeps its status.
  const RunStatus status = read_status(from);
  hdf5::write_attribute(to, "status",
                        to_string(status == RunStatus::running ? RunStatus::interrupted : status));
  for (const char* name : {"rest", "constraints", "provenance", "timing", "summary"})
    if (hdf5::has_link(from, name)) copy(from, to, name);
  copy_vtkhdf(from, to, shape);
  copy_metrics(from, to, shape.times.size());
  write_steps(to, shape);
}

}  // namespace

std::uint64_t repair_run(const fs::path& part_file) {
  if (part_file.extension() != ".part")
    throw file_error(part_file, "can't be repaired", "the file of an unfinished run ends in .part", 0);
  require_readable(part_file);
  require_writable(part_file);
  const fs::path path = fs::path(part_file).replace_extension(), copied = path.string() + ".repair";
  require_writable(copied);
  const auto shape = with_run(part_file, [&](hid_t from) {
    const auto committed = read_shape(from);
    try {
      Handle to = hdf5::create_file(copied.string());
      copy_run(from, to, committed);
      hdf5::flush(to);
      to.close();
    } catch (const hdf5::Failure& failure) {
      fs::remove(copied);
      throw file_error(part_file, "can't be repaired", failure.what(), failure.code());
    }
    return committed;
  });
  write_xdmf(path, shape);
  publish(copied, path);
  fs::remove(part_file);
  return shape.times.size();
}

}  // namespace bendlab
