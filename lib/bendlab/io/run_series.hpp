// Opens a run file, and reads the parts that every reader needs. For source files of this folder only.
#pragma once

#include <filesystem>

#include "bendlab/io/disk.hpp"
#include "bendlab/io/facts.hpp"
#include "bendlab/io/hdf5_handles.hpp"
#include "bendlab/io/paraview.hpp"
#include "bendlab/io/run_file.hpp"

namespace bendlab {

inline constexpr const char* metric_values = "/metrics/values";

/// Writes a compressed JSON text to the dataset `name`: "facts" or "outcome" (see run_file.hpp).
void write_facts(hid_t file, const char* name, const Json& facts);
/// Reads /outcome if the file has that dataset. Otherwise reads /facts.
Json read_facts(hid_t file);

/// Name, unit and meaning of every metric, `time` first.
std::vector<Column> metric_columns(hid_t file);
/// The first `count` values of every metric.
std::vector<MetricRecord> read_all_metrics(hid_t file, std::uint64_t count);

/// Opens a run file for reading. Throws hdf5::Failure if the file is not a run file.
hdf5::Handle open_run(const std::filesystem::path& path);

/// Numbers of vertices and triangles, names of the cell fields, and times of the completely written frames.
ParaViewShape read_shape(hid_t file);

/// Opens the file and calls `action(hid_t file)`, with the lock for HDF5. Turns failures into RunFileError.
template <class Action>
auto with_run(const std::filesystem::path& path, const Action& action) {
  require_readable(path);
  try {
    const hdf5::Lock lock;
    const hdf5::Handle file = open_run(path);
    return action(file);
  } catch (const hdf5::Failure& failure) {
    throw file_error(path, "can't be read as a run file", failure.what(), failure.code());
  } catch (const Json::exception& error) {
    throw file_error(path, "can't be read as a run file", error.what(), 0);
  } catch (const std::invalid_argument& error) {  // an unknown status
    throw file_error(path, "can't be read as a run file", error.what(), 0);
  }
}

}  // namespace bendlab
