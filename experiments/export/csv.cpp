// CSV (RFC 4180, but lines end in a line feed alone): the metrics of a run for a spreadsheet. A number has as
// few digits as possible, but enough to read the same number again. NaN becomes an empty cell.
//
//   summary.csv    name,value,unit,meaning    the metrics of the summary
//   frames.csv     frame,time,…               a row per frame, a column per metric
//   columns.csv    name,unit,meaning          the columns of frames.csv
#include <algorithm>
#include <cmath>

#include "experiments/export/format.hpp"
#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

// Quotes a text if it has to be quoted.
std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

std::string csv_number(double value) {
  return std::isnan(value) ? std::string() : fmt::format("{}", value);
}

// Unit and meaning of a metric of the summary; empty if no measure gives the metric.
Quantity metric_of(const std::string& name) {
  for (const Measure* measure : measures()) {
    const std::vector<Quantity> all = measure->gives();
    if (const auto metric = std::ranges::find(all, name, &Quantity::name); metric != all.end())
      return *metric;
  }
  return {name, "", ""};
}

void write_summary(const ExportedRun& run, OutputFile& file) {
  file.write("name,value,unit,meaning\n");
  for (const auto& [name, value] : run.record.summary) {
    const Quantity metric = metric_of(name);
    file.print("{},{},{},{}\n", csv_cell(name), csv_number(value), csv_cell(metric.unit),
               csv_cell(metric.meaning));
  }
}

void write_frames(const ExportedRun& run, const std::vector<MetricRecord>& metrics, OutputFile& file) {
  file.write("frame");
  for (const MetricRecord& metric : metrics) file.print(",{}", csv_cell(metric.column.name));
  file.write("\n");
  for (const ExportedFrame& frame : run.frames) {
    file.print("{}", frame.number);
    for (const MetricRecord& metric : metrics)
      file.print(",{}", csv_number(metric.values.at(static_cast<std::size_t>(frame.number))));
    file.write("\n");
  }
}

void write_columns(const std::vector<MetricRecord>& metrics, OutputFile& file) {
  file.write("name,unit,meaning\nframe,1,number of the frame in the run\n");
  for (const auto& [column, values] : metrics)
    file.print("{},{},{}\n", csv_cell(column.name), csv_cell(column.unit), csv_cell(column.meaning));
}

void write_csv(const ExportedRun& run, Output& output) {
  const std::vector<MetricRecord> metrics = read_metrics(run.record.file);
  output.file("summary.csv", [&](OutputFile& file) { write_summary(run, file); });
  output.file("frames.csv", [&](OutputFile& file) { write_frames(run, metrics, file); });
  output.file("columns.csv", [&](OutputFile& file) { write_columns(metrics, file); });
}

}  // namespace

namespace format {
extern const Format csv{
    .name = "csv",
    .summary = "tables of the summary and of every frame's metrics, without the cloth",
    .has_times = true,
    .write = write_csv,
};
}  // namespace format
}  // namespace bendlab
