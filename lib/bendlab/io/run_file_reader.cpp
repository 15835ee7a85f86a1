#include <fmt/ranges.h>

#include <algorithm>

#include "bendlab/io/run_series.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;
using hdf5::Handle;

}  // namespace

std::vector<fs::path> unfinished_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (const std::string name = entry->path().filename().string();
        name.starts_with("run.vtkhdf") && name.ends_with(".part"))
      files.push_back(entry->path());
  std::ranges::sort(files);
  return files;
}

RunRecord read_run(const fs::path& path) {
  return with_run(path, [&](hid_t file) {
    RunRecord run = record_of(read_facts(file), path);
    run.frames = read_shape(file).times.size();
    return run;
  });
}

RestRecord read_rest(const fs::path& path) {
  return with_run(path, [&](hid_t file) {
    const Handle rest = hdf5::open_group(file, "rest");
    return RestRecord{.positions = hdf5::read_all<double>(rest, "positions"),
                      .triangles = hdf5::read_all<int>(rest, "triangles"),
                      .pinned = hdf5::read_all<std::uint8_t>(rest, "pinned"),
                      .pin_seeds = hdf5::read_all<int>(rest, "pin_seeds"),
                      .double_positions = read_shape(file).double_positions};
  });
}

std::vector<InputFile> read_inputs(const fs::path& path) {
  return with_run(path, [&](hid_t file) {
    const Json facts = read_facts(file);
    std::vector<InputFile> inputs;
    for (const Json& input : facts.at("inputs")) {
      const std::string dataset = fmt::format("/provenance/inputs/{}", inputs.size());
      const auto bytes = hdf5::read_all<std::uint8_t>(file, dataset);
      inputs.push_back({input.at(0), input.at(1), {bytes.begin(), bytes.end()}});
    }
    return inputs;
  });
}

std::string xdmf_of(const fs::path& run_file, const std::string& as_seen,
                    std::span<const std::int64_t> frames) {
  return xdmf_text(as_seen, with_run(run_file, read_shape), frames);
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

std::vector<double> read_metric(const fs::path& path, const std::string& name) {
  return with_run(path, [&](hid_t file) {
    std::vector<std::string> names;
    for (Column& metric : metric_columns(file)) names.push_back(std::move(metric.name));
    const auto column = std::ranges::find(names, name);
    if (column == names.end())
      throw hdf5::Failure(fmt::format("it has no metric '{}', only {}", name, fmt::join(names, ", ")));
    return hdf5::read_column(hdf5::open_dataset(file, metric_values),
                             static_cast<hsize_t>(column - names.begin()), read_shape(file).times.size());
  });
}

std::vector<MetricRecord> read_metrics(const fs::path& path) {
  return with_run(path, [&](hid_t file) {
    std::vector<MetricRecord> metrics = read_all_metrics(file, read_shape(file).times.size());
    std::ranges::sort(metrics, {}, [](const MetricRecord& metric) {
      return std::pair(metric.column.name != "time", metric.column.name);
    });
    return metrics;
  });
}

std::vector<double> read_positions(const fs::path& path, std::int64_t frame) {
  return with_run(path, [&](hid_t file) {
    const auto shape = read_shape(file);
    const auto frames = static_cast<std::int64_t>(shape.times.size());
    const std::int64_t index = frame < 0 ? frames + frame : frame;
    if (index < 0 || index >= frames)
      throw hdf5::Failure(
          fmt::format("it has no frame {}; it has {} {}", frame, frames, frames == 1 ? "frame" : "frames"));
    const Handle points = hdf5::open_dataset(file, "/VTKHDF/Points");
    return hdf5::read_rows<double>(points, static_cast<std::uint64_t>(index) * shape.vertices,
                                   shape.vertices);
  });
}

}  // namespace bendlab
