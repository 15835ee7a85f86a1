// The datasets of a run that grow with its frames, and how a run file is opened for reading. Only sources of
// this folder include this header.
#pragma once

#include <filesystem>

#include "bendlab/io/disk.hpp"
#include "bendlab/io/facts.hpp"
#include "bendlab/io/hdf5_handles.hpp"
#include "bendlab/io/paraview.hpp"
#include "bendlab/io/run_file.hpp"

namespace bendlab {

hdf5::Series create_points(hid_t vtk, const ParaViewShape& shape);
hdf5::Series create_cell_field(hid_t cell_data, const std::string& name, const ParaViewShape& shape);
/// In /metrics: `time`, then the metrics of the header.
hdf5::Series create_metric_values(hid_t metrics, std::size_t columns);
inline constexpr const char* metric_values = "values";
inline constexpr hsize_t metric_rows_per_chunk = 32;

std::vector<std::string> metric_names(hid_t file);
std::vector<Column> metric_columns(hid_t file);

/// The first `count` rows of a column of /metrics. Throws hdf5::Failure if there is none of that name.
std::vector<double> read_metric_rows(hid_t file, const std::string& name, std::uint64_t count);
/// The same of every column, in the order of metric_names().
std::vector<std::vector<double>> read_all_metrics(hid_t file, std::uint64_t count);

/// Opens a run file for reading. Throws hdf5::Failure if it is something else.
hdf5::Handle open_run(const std::filesystem::path& path);

RunStatus read_status(hid_t file);

/// V, T, the names of the cell fields and the times of the committed frames.
ParaViewShape read_shape(hid_t file);

/// Calls `action(hid_t file)` under the lock. Turns a failure into a RunFileError that names the file.
template <class Action>
auto with_run(const std::filesystem::path& path, const Action& action) {
  require_readable(path);
  try {
    const hdf5::Lock lock;
    const hdf5::Handle file = open_run(path);
    return action(file);
  } catch (const hdf5::Failure& failure) {
    throw file_error(path, "can't be read as a run file", failure.what(), failure.code());
  }
}

}  // namespace bendlab
