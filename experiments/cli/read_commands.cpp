// `bendlab list` and `bendlab show`: the runs below a folder, and one run.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "bendlab/scene/counted.hpp"
#include "bendlab/scene/json_text.hpp"
#include "bendlab/scene/nearest_name.hpp"
#include "experiments/cli/find_run.hpp"
#include "experiments/config/settings_by_pointer.hpp"
#include "experiments/run/broken_bound.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/run_record.hpp"
#include "experiments/run/warning.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

/// When the file was last written, local time.
std::string when(const fs::path& file) {
  const auto written = std::chrono::file_clock::to_sys(fs::last_write_time(file));
  const std::time_t time = std::chrono::system_clock::to_time_t(
      std::chrono::time_point_cast<std::chrono::system_clock::duration>(written));
  std::tm local{};
  localtime_r(&time, &local);
  char text[20] = "";
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local);
  return text;
}

Json to_json(const RunRecord& record) {
  Json passes = Json::array();
  for (const PassTime& pass : record.passes)
    passes.push_back({{"name", pass.name}, {"seconds", pass.seconds}, {"calls", pass.calls}});
  return {{"id", record.id},
          {"name", record.name},
          {"status", to_string(record.status)},
          {"file", record.file.string()},
          {"frames", record.frames},
          {"written", when(record.file)},
          {"config", Json::parse(record.config)},
          {"wall_s", record.wall_s},
          {"cpu_s", record.cpu_s},
          {"step_cpu_s", record.step_cpu_s},
          {"summary", record.summary},
          {"passes", passes},
          {"implausible", provenance_json(record, "implausible")},
          {"warnings", provenance_json(record, "warnings")},
          {"provenance", record.provenance}};
}

void print_section(const char* heading, const std::map<std::string, std::string>& rows) {
  if (rows.empty()) return;
  Table table({heading, ""});
  for (const auto& [name, value] : rows) table.add_row({"  " + name, value});
  print_text("\n{}", table.text());
}

// Throws UsageError if no run has the setting or metric `name`. A setting is named by its pointer.
void require_known(const std::vector<RunRecord>& records, const char* option, const std::string& name) {
  std::vector<std::string> known;
  for (const RunRecord& record : records) {
    if (name.starts_with('/')) {
      const Json config = Json::parse(record.config);
      if (value_at(config, name)) return;
      const Json flat = config.flatten();
      for (const auto& [pointer, value] : flat.items()) known.push_back(pointer);
    } else {
      if (record.summary.contains(name)) return;
      for (const auto& [metric, value] : record.summary) known.push_back(metric);
    }
  }
  if (records.empty()) return;
  throw UsageError(fmt::format("{}: no run has the {} '{}'{}", option,
                               name.starts_with('/') ? "setting" : "metric", name, suggestion(name, known)));
}

// The runs whose configs have all values of `where`.
std::vector<RunRecord> chosen(std::vector<RunRecord> records, const std::vector<std::string>& where) {
  std::vector<std::pair<std::string, std::string>> wanted;
  for (const std::string& text : where) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || !text.starts_with('/'))
      throw UsageError(fmt::format("--where: '{}' is not of the form /json/pointer=value", text));
    wanted.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    require_known(records, "--where", wanted.back().first);
  }
  for (const auto& setting : wanted) {
    const Json text = setting.second;
    const Json parsed = Json::parse(setting.second, nullptr, false);
    std::erase_if(records, [&](const RunRecord& record) {
      const Json config = Json::parse(record.config);
      const Json* const value = value_at(config, setting.first);
      return value == nullptr || !(*value == parsed || *value == text);
    });
  }
  return records;
}

// Runs that do not have `name` come last.
void sort_by(std::vector<RunRecord>& records, const std::string& name) {
  const auto key = [&](const RunRecord& record) -> std::pair<bool, Json> {
    if (name.starts_with('/')) {
      const Json config = Json::parse(record.config);
      const Json* const value = value_at(config, name);
      return {value == nullptr, value ? *value : Json()};
    }
    const auto found = record.summary.find(name);
    return {found == record.summary.end(), found == record.summary.end() ? Json() : Json(found->second)};
  };
  std::ranges::stable_sort(records, {}, key);
}

struct ListCommand : Command {
  std::string folder = "results", sort;
  std::vector<std::string> where;  // "/json/pointer=value"

  ListCommand() {
    add(folder, "[DIR]", "Folder of results");
    add(where, "--where /POINTER=VALUE...",
        "Only runs whose config has this value, such as /mesh/cells=64. Repeatable");
    add(sort, "--sort NAME",
        "Sort by a metric of the summary, such as drop, or by a setting, such as /mesh/cells; smallest "
        "first");
    add(json, "--json", "Print one JSON object per run");
  }

  int run() override {
    std::vector<RunRecord> records = chosen(read_runs(folder), where);
    if (!sort.empty()) require_known(records, "--sort", sort), sort_by(records, sort);
    std::vector<std::string> headings = {"id",       "name",        "status",          "frames", "written",
                                         "vertices", "mean_strain", "pin_max_stretch", "wall_s"};
    const bool own_column = !sort.empty() && std::ranges::find(headings, sort) == headings.end();
    if (own_column) headings.push_back(sort);
    Table table(headings);
    for (const RunRecord& record : records) {
      if (json) print_text("{}\n", json_text(to_json(record)));
      const auto number = [&](const char* name) {
        const auto found = record.summary.find(name);
        return found == record.summary.end() ? std::string() : format_number(found->second);
      };
      std::vector<std::string> row = {record.id, record.name, to_string(record.status)};
      row.insert(row.end(),
                 {fmt::format("{}", record.frames), when(record.file), number("vertices"),
                  number("mean_strain"), number("pin_max_stretch"), fmt::format("{:.1f}", record.wall_s)});
      if (own_column) {
        const Json config = Json::parse(record.config);
        const Json* const value = sort.starts_with('/') ? value_at(config, sort) : nullptr;
        row.push_back(value ? value->dump() : number(sort.c_str()));
      }
      table.add_row(row);
    }
    if (json) return exit_ok;
    if (records.empty())
      print_text("no {}runs in {}\n", where.empty() ? "" : "such ", folder);
    else
      print_text("{}", table.text());
    return exit_ok;
  }
};

struct ShowCommand : Command {
  RunArgument asked{*this};

  ShowCommand() { add(json, "--json", "Print one JSON object"); }

  int run() override {
    const RunRecord record = asked.found();
    const Json description = to_json(record);
    if (json) {
      print_text("{}\n", json_text(description));
      return exit_ok;
    }
    print_text("{}\n{}  {}  {}, {}, written {}\n", record.file.string(), record.id, record.name,
               to_string(record.status), counted(record.frames, "frame"), when(record.file));
    if (const auto broken = broken_bound_of(provenance_json(record, "implausible")))
      print_text("\nimplausible: {}\n", text_of(*broken));
    for (const Warning& warning : warnings_of(provenance_json(record, "warnings")))
      print_text("\nwarning {}: {}\n", warning.code, warning.message);

    std::map<std::string, std::string> summary;
    for (const auto& [name, value] : record.summary) summary[name] = format_number(value);
    print_section("summary", summary);

    if (!record.passes.empty()) {
      double all = 0;
      for (const PassTime& pass : record.passes) all += pass.seconds;
      Table passes({"pass", "seconds", "%", "calls"});
      for (const PassTime& pass : record.passes)
        passes.add_row({"  " + pass.name, fmt::format("{:.3f}", pass.seconds),
                        fmt::format("{:.1f}", all > 0 ? 100 * pass.seconds / all : 0.0),
                        fmt::format("{}", pass.calls)});
      print_text("\n{}wall {:.2f} s, CPU {:.2f} s\n", passes.text(), record.wall_s, record.cpu_s);
    }
    std::map<std::string, std::string> provenance = record.provenance;
    for (const char* printed : {"implausible", "warnings"}) provenance.erase(printed);
    print_section("provenance", provenance);
    print_text("\nconfig\n{}\n",
               description.at("config").dump(2, ' ', false, Json::error_handler_t::replace));
    return exit_ok;
  }
};

}  // namespace

extern const CommandKind list_command{"list", "List the runs below a folder",
                                      "bendlab list results --where /bending/model=adaptive --sort drop",
                                      make<ListCommand>};
extern const CommandKind show_command{"show", "Show a run: summary, time per pass, provenance, config",
                                      "bendlab show results/first", make<ShowCommand>};

}  // namespace bendlab
