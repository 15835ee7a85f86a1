#include <fmt/format.h>

#include <algorithm>

#include "bendlab/io/run_series.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;
using hdf5::Handle;

std::vector<PassTime> read_passes(hid_t timing) {
  const auto names = hdf5::read_texts(timing, "pass");
  const auto seconds = hdf5::read_all<double>(timing, "seconds");
  const auto calls = hdf5::read_all<std::uint64_t>(timing, "calls");
  std::vector<std::uint64_t> acted(names.size(), 0);
  if (hdf5::has_link(timing, "acted")) acted = hdf5::read_all<std::uint64_t>(timing, "acted");
  std::vector<PassTime> passes;
  for (std::size_t i = 0; i < names.size(); ++i)
    passes.push_back({names[i], seconds.at(i), calls.at(i), acted.at(i)});
  return passes;
}

void take(const Facts& facts, RunRecord& run) {
  run.provenance = facts.texts_in("provenance");
  run.config = facts.text("config");
  for (const Column& column : facts.metrics()) run.metrics.push_back(column.name);
  for (const auto& [kind, count] : facts.numbers_in("counts"))
    run.constraints[kind] = static_cast<std::uint64_t>(count);
  run.summary = facts.numbers_in("summary");
  run.passes = facts.passes();
  std::map<std::string, double> timing = facts.numbers_in("timing");
  run.wall_s = timing["wall_s"], run.cpu_s = timing["cpu_s"], run.step_cpu_s = timing["step_cpu_s"];
}

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
    RunRecord run;
    run.file = path;
    run.id = hdf5::read_text_attribute(file, "id");
    run.name = hdf5::read_text_attribute(file, "name");
    run.status = read_status(file);
    run.frames = read_shape(file).times.size();
    if (const std::optional<Facts> facts = read_facts(file)) {
      take(*facts, run);
      return run;
    }
    const Handle provenance = hdf5::open_group(file, "provenance");
    run.provenance = hdf5::read_text_attributes(provenance);
    run.config = hdf5::read_texts(provenance, "config").at(0);
    run.metrics = metric_names(file);
    const Handle constraints = hdf5::open_group(file, "constraints");
    for (const std::string& kind : hdf5::links(constraints))
      run.constraints[kind] = static_cast<std::uint64_t>(
          hdf5::read_number_attribute(hdf5::open_group(constraints, kind), "count"));
    if (run.status == RunStatus::running || !hdf5::has_link(file, "summary")) return run;
    const Handle timing = hdf5::open_group(file, "timing");
    run.passes = read_passes(timing);
    run.wall_s = hdf5::read_number_attribute(timing, "wall_s");
    run.cpu_s = hdf5::read_number_attribute(timing, "cpu_s");
    run.step_cpu_s = hdf5::read_number_attributes(timing)["step_cpu_s"];  // 0 in older files
    run.summary = hdf5::read_number_attributes(hdf5::open_group(file, "summary"));
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
    std::vector<InputFile> inputs;
    if (!hdf5::has_link(file, "provenance")) return inputs;  // a short run without such files
    const Handle provenance = hdf5::open_group(file, "provenance");
    if (!hdf5::has_link(provenance, "inputs")) return inputs;
    const Handle group = hdf5::open_group(provenance, "inputs");
    const std::optional<Facts> facts = read_facts(file);
    for (const std::string& name : hdf5::links(group)) {
      const Handle dataset = hdf5::open_dataset(group, name);
      const auto bytes = hdf5::read_all<std::uint8_t>(group, name);
      const std::string pointer = facts ? facts->text("pointers/" + name)
                                        : hdf5::read_text_attribute(dataset, "pointer");
      const std::string said =
          facts ? facts->text("files/" + name) : hdf5::read_text_attribute(dataset, "name");
      inputs.push_back({pointer, said, {bytes.begin(), bytes.end()}});
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
    return read_metric_rows(file, name, read_shape(file).times.size());
  });
}

std::vector<MetricRecord> read_metrics(const fs::path& path) {
  return with_run(path, [&](hid_t file) {
    std::vector<std::vector<double>> values = read_all_metrics(file, read_shape(file).times.size());
    std::vector<MetricRecord> records;
    for (const Column& column : metric_columns(file))
      records.push_back({column, std::move(values[records.size()])});
    std::ranges::sort(records, {}, [](const MetricRecord& each) {
      return std::pair(each.column.name != "time", each.column.name);
    });
    return records;
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
