// `bendlab compare`: what differs between two runs, or between two sweeps point by point.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "bendlab/scene/counted.hpp"
#include "bendlab/scene/json_text.hpp"
#include "experiments/campaign/compare.hpp"
#include "experiments/cli/find_run.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/run_record.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::optional<double>& number) {
  return number ? format_number(*number) : "-";
}

std::string percent_of(const std::optional<double>& relative) {
  return relative ? fmt::format("{:+.2g} %", 100 * *relative) : "";
}

std::string text_of(const Json& value) {
  return value.is_null() ? "-" : value.is_string() ? value.get<std::string>() : json_text(value);
}

Json number_or_null(const std::optional<double>& number) {
  return number ? Json(*number) : Json();
}

Json to_json(const RunRecord& one, const RunRecord& other, const RunDifference& found) {
  Json settings = Json::array(), summary = Json::array();
  for (const ChangedSetting& setting : found.settings)
    settings.push_back({{"pointer", setting.pointer}, {"one", setting.one}, {"other", setting.other}});
  for (const ChangedNumber& metric : found.summary)
    summary.push_back({{"name", metric.name},
                       {"one", number_or_null(metric.one)},
                       {"other", number_or_null(metric.other)},
                       {"relative", number_or_null(metric.relative)}});
  return {{"one", one.file.string()},
          {"other", other.file.string()},
          {"same_bits", found.differing_parts.empty()},
          {"differing_parts", found.differing_parts},
          {"settings", settings},
          {"summary", summary},
          {"cloth", found.cloth},
          {"no_cloth", found.no_cloth}};
}

void print_pair(const RunRecord& one, const RunRecord& other, const RunDifference& found) {
  print_text("one:   {}  {}\nother: {}  {}\n", one.id, one.file.string(), other.id, other.file.string());
  if (found.differing_parts.empty())
    print_text("\nfiles: the same bits in every frame and metric\n");
  else
    print_text("\nfiles: {} differ in their bits: {}\n", counted(found.differing_parts.size(), "part"),
               fmt::join(found.differing_parts, ", "));
  if (found.settings.empty()) print_text("\nsettings: the same\n");
  if (!found.settings.empty()) {
    Table table({"setting", "one", "other"});
    for (const ChangedSetting& setting : found.settings)
      table.add_row({setting.pointer, text_of(setting.one), text_of(setting.other)});
    print_text("\n{}", table.text());
  }
  if (found.summary.empty()) print_text("\nsummary: the same\n");
  if (!found.summary.empty()) {
    Table table({"metric", "one", "other", "change"});
    for (const ChangedNumber& metric : found.summary)
      table.add_row({metric.name, text_of(metric.one), text_of(metric.other), percent_of(metric.relative)});
    print_text("\n{}", table.text());
  }
  if (!found.no_cloth.empty()) print_text("\ncloths: not compared: {}\n", found.no_cloth);
  if (!found.cloth.empty()) {
    print_text("\ncloths: distances in sizes of the mesh, over the frames at the same times\n");
    Table table({"distance", "value"});
    for (const auto& [name, value] : found.cloth) table.add_row({name, format_number(value)});
    print_text("{}", table.text());
  }
}

// The runs of a folder by experiment and point of the sweep. The order of the axes does not matter.
struct RunsByPoint {
  std::map<std::pair<std::string, std::string>, RunRecord> runs;
  std::set<std::string> experiments;
  std::size_t left_out = 0;  // runs at a point that has several runs

  // If a point has several runs, keeps the run that ended last.
  explicit RunsByPoint(const fs::path& folder) {
    for (RunRecord& record : read_runs(folder)) {
      if (record.file.string().find("/references/") != std::string::npos) continue;
      const nlohmann::json point = nlohmann::json::parse(provenance_text(record, "point"), nullptr, false);
      experiments.insert(record.name);
      const auto [place, is_new] =
          runs.try_emplace({record.name, point.is_object() ? point.dump() : "{}"}, record);
      if (is_new) continue;
      ++left_out;
      if (provenance_text(place->second, "ended") <= provenance_text(record, "ended"))
        place->second = std::move(record);
    }
  }
  // Drops the experiments' names, so that two sweeps with different names can be compared.
  void forget_experiment() {
    decltype(runs) nameless;
    for (auto& [place, run] : runs) nameless.emplace(std::pair("", place.second), std::move(run));
    runs = std::move(nameless);
  }
};

bool has_many_runs(const std::string& argument) {
  if (!fs::is_directory(argument)) return false;
  return !fs::exists(fs::path(argument) / "run.vtkhdf") && unfinished_files(argument).empty();
}

struct CompareCommand : Command {
  std::string one, other, folder = "results";

  CompareCommand() {
    add(one, "ONE",
        "A run file, the folder of a run file, the beginning of a run's id, or the folder of a sweep");
    add(other, "OTHER", "The run or sweep to compare with, named in the same way");
    add_results(*this, folder);
    add(json, "--json", "Print one JSON object per pair of runs");
  }
  int run() override;
};

// Compares two sweeps point by point, in the most important metrics.
int compare_sweeps(const CompareCommand& arguments) {
  RunsByPoint ones(arguments.one), others(arguments.other);
  if (ones.experiments.size() == 1 && others.experiments.size() == 1)
    ones.forget_experiment(), others.forget_experiment();
  const std::vector<std::string> names = {"mean_strain", "max_stretch", "drop", "step_cpu_s"};
  std::vector<std::string> headings = {"point"};
  for (const std::string& name : names) headings.push_back(name + " (change)");
  headings.push_back("bits");
  Table table(headings);
  std::size_t in_both = 0;
  for (const auto& [place, one] : ones.runs) {
    const auto found = others.runs.find(place);
    if (found == others.runs.end()) continue;
    ++in_both;
    const RunRecord& other = found->second;
    const RunDifference pair = difference(one, other);
    if (arguments.json) print_text("{}\n", json_text(to_json(one, other, pair)));
    std::vector<std::string> row = {place.first.empty() ? place.second
                                                        : fmt::format("{} {}", place.first, place.second)};
    for (const std::string& name : names) {
      const auto value = [&](const RunRecord& record) -> std::optional<double> {
        if (name == "step_cpu_s") return record.step_cpu_s;
        const auto at = record.summary.find(name);
        return at == record.summary.end() ? std::nullopt : std::optional(at->second);
      };
      const std::optional<double> before = value(one), after = value(other);
      row.push_back(before && after && *before != 0
                        ? fmt::format("{} ({:+.2g} %)", format_number(*after), 100 * (*after / *before - 1))
                        : text_of(after));
    }
    row.push_back(pair.differing_parts.empty() ? "same" : "differ");
    table.add_row(row);
  }
  if (in_both == 0)
    throw UsageError(
        fmt::format("'{}' and '{}' have no point of a sweep in common", arguments.one, arguments.other));
  if (!arguments.json)
    print_text("{}{} in both, {} only in ONE, {} only in OTHER\n", table.text(), counted(in_both, "point"),
               ones.runs.size() - in_both, others.runs.size() - in_both);
  for (const auto& [folder, runs] : {std::pair(&arguments.one, &ones), std::pair(&arguments.other, &others)})
    if (runs->left_out > 0)
      print_text(
          stderr,
          "bendlab: '{}' has several runs at some points of the sweep. At such a point, only the run that "
          "ended last was compared ({} left out). To compare another run, name the run by its id\n",
          *folder, counted(runs->left_out, "run"));
  return exit_ok;
}

int CompareCommand::run() {
  if (has_many_runs(one) && has_many_runs(other)) return compare_sweeps(*this);
  const RunRecord first = find_run(one, folder), second = find_run(other, folder);
  const RunDifference found = difference(first, second);
  if (json)
    print_text("{}\n", json_text(to_json(first, second, found)));
  else
    print_pair(first, second, found);
  return exit_ok;
}

}  // namespace

extern const CommandKind compare_command{"compare", "Show what differs between two runs, or two sweeps",
                                         "bendlab compare results/first results/second",
                                         make<CompareCommand>};

}  // namespace bendlab
