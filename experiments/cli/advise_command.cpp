#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "bendlab/bending/model.hpp"
#include "bendlab/io/run_file.hpp"
#include "experiments/advise/advice.hpp"
#include "experiments/cli/commands.hpp"
#include "experiments/cli/errors.hpp"
#include "experiments/cli/signals.hpp"
#include "experiments/cli/table.hpp"
#include "experiments/nearest_name.hpp"

namespace bendlab {
namespace {

// The value after an option; what is wrong with it is a matter of usage.
template <class Parse>
double read_option(const char* option, const std::string& text, Parse parse) try {
  return parse(text);
} catch (const std::invalid_argument& error) {
  throw UsageError(fmt::format("{}: {}", option, error.what()));
}

Demand demand_of(const AdviseArguments& arguments) {
  if (arguments.error.empty() == arguments.budget.empty())
    throw UsageError(
        "advise needs one of --error 5% (the fastest that is as accurate) and --budget 2ms (the most "
        "accurate "
        "that is as fast, CPU time per frame)");
  if (!arguments.error.empty()) return {.error = read_option("--error", arguments.error, parse_error)};
  return {.cpu_s = read_option("--budget", arguments.budget, parse_duration)};
}

std::optional<ErrorOf> error_of(const std::string& what) {
  if (what == "rest") return ErrorOf::rest;
  if (what == "motion") return ErrorOf::motion;
  return std::nullopt;
}

void check_models(const std::vector<std::string>& models) {
  std::vector<std::string_view> known;
  for (const BendingModel* model : bending_models()) known.push_back(model->name);
  for (const std::string& model : models)
    if (find_bending_model(model) == nullptr)
      throw UsageError(fmt::format("--models: there is no bending model '{}'{} Models: {}", model,
                                   suggestion(model, known).empty() ? "." : suggestion(model, known),
                                   fmt::join(known, ", ")));
}

std::string what_text(const Advice& advice, const Question& question) {
  const std::string gap =
      advice.reference_gap ? fmt::format(", itself known to {}", percent_text(*advice.reference_gap)) : "";
  const char* cloth =
      question.reference_model() == "dihedral" ? "calibrated hinges" : "the config's own springs";
  switch (advice.error_of) {
    case ErrorOf::own:
      return fmt::format("against the reference of the config's own /accuracy{}", gap);
    case ErrorOf::motion:
      return fmt::format("of the motion, mean over the frames, against {} with {} substeps{}", cloth,
                         question.reference_substeps(), gap);
    case ErrorOf::rest:
      return fmt::format(
          "of the pose at the end, against the static equilibrium of {}, turned about the vertical{}", cloth,
          advice.many_equilibria ? "; there are many, each run is compared with the one beside it" : "");
  }
  throw std::logic_error("what_text: unknown kind of error");
}

const char* how(const Rated& point) {
  return point.predicted ? "predicted" : "measured";
}

std::string point_text(const Rated& point) {
  return fmt::format("{}: error {}, {:.3g} ms of CPU per frame ({})", setting_text(point.setting),
                     percent_text(point.error), 1e3 * point.cpu_s, how(point));
}

std::string front_text(const std::vector<Rated>& front, const Advice& advice) {
  const auto strain = [&](const Rated& point) {
    const auto found = advice.strain.find(point.setting);
    return found == advice.strain.end() ? "" : percent_number(found->second);
  };
  Table table(
      {"model", "substeps", "iterations", "precision", "error (%)", "strain (%)", "ms per frame", ""});
  for (const Rated& point : front)
    table.add_row({point.setting.model, std::to_string(point.setting.substeps),
                   std::to_string(point.setting.iterations),
                   point.setting.double_precision ? "double" : "single", percent_number(point.error),
                   strain(point), fmt::format("{:.3g}", 1e3 * point.cpu_s), how(point)});
  return table.text();
}

std::string demand_text(const Demand& demand) {
  return demand.error ? fmt::format("an error of {}", percent_text(*demand.error))
                      : fmt::format("{:.4g} ms of CPU per frame", 1e3 * *demand.cpu_s);
}

void print_text(const Advice& advice, const Question& question, const Demand& demand) {
  if (advice.best)
    fmt::print("{}: take {}\n", question.name(), point_text(*advice.best));
  else if (advice.nearest)
    fmt::print("{}: no setting {}meets {}; nearest is {}\n", question.name(),
               advice.out_of_time ? "run so far " : "", demand_text(demand), point_text(*advice.nearest));
  else
    fmt::print("{}: no setting gave an error\n", question.name());
  fmt::print("\nerror: rms {}, in sizes of the mesh\n\n{}", what_text(advice, question),
             front_text(thinned(advice.front), advice));
  constexpr double at_rest = 0.02;  // sizes per second
  if (advice.error_of == ErrorOf::rest && advice.still_moving > at_rest)
    fmt::print(
        "\nThe cloth still moves at the end of /duration, by {} of its size per second: a longer one brings "
        "it to "
        "rest, --what motion compares its motion.\n",
        percent_text(advice.still_moving));
  if (demand.error && advice.reference_gap.value_or(0) >= *demand.error)
    fmt::print("\nThe reference itself is known to {} only: motions that fall and fold are chaotic.\n",
               percent_text(*advice.reference_gap));
  if (const auto& point = advice.best ? advice.best : advice.nearest) {
    constexpr double close = 10;
    if (advice.reference_gap && point->error < close * *advice.reference_gap)
      fmt::print("\nThe reference itself is not known ten times as well as this error.\n");
    fmt::print("\nto use it:\n");
    for (const std::string& change : question.changes(point->setting)) fmt::print("  --set {}\n", change);
  }
  if (!advice.left_out.empty()) fmt::print("\nnot on this front:\n");
  for (const LeftOut& each : advice.left_out) fmt::print("  {}: {}\n", each.what, each.why);
}

Json point_json(const std::optional<Rated>& point, const Advice& advice) {
  if (!point) return nullptr;
  const auto strain = advice.strain.find(point->setting);
  return {{"model", point->setting.model},
          {"substeps", point->setting.substeps},
          {"iterations", point->setting.iterations},
          {"precision", point->setting.double_precision ? "double" : "single"},
          {"error", point->error},
          {"strain", strain == advice.strain.end() ? Json(nullptr) : Json(strain->second)},
          {"cpu_s_per_frame", point->cpu_s},
          {"predicted", point->predicted}};
}

Json points_json(const std::vector<Rated>& points, const Advice& advice) {
  Json list = Json::array();
  for (const Rated& point : points) list.push_back(point_json(point, advice));
  return list;
}

Json advice_json(const Advice& advice, const Question& question, const Demand& demand) {
  constexpr const char* kinds[] = {"rest", "motion", "own"};
  Json left_out = Json::array();
  for (const LeftOut& each : advice.left_out) left_out.push_back({{"what", each.what}, {"why", each.why}});
  Json json = {
      {"name", question.name()},
      {"demand", demand.error ? Json{{"error", *demand.error}} : Json{{"cpu_s_per_frame", *demand.cpu_s}}},
      {"error_of", kinds[static_cast<int>(advice.error_of)]},
      {"many_equilibria", advice.many_equilibria},
      {"still_moving", advice.still_moving},
      {"reference_gap", advice.reference_gap ? Json(*advice.reference_gap) : Json(nullptr)},
      {"accuracy", advice.accuracy},
      {"advice", point_json(advice.best, advice)},
      {"nearest", point_json(advice.nearest, advice)},
      {"set", Json::array()},
      {"front", points_json(advice.front, advice)},
      {"points", points_json(advice.points, advice)},
      {"left_out", left_out},
      {"computed_runs", advice.computed},
      {"complete", !advice.out_of_time}};
  if (const auto& point = advice.best ? advice.best : advice.nearest)
    json["set"] = question.changes(point->setting);
  return json;
}

// Before anything is computed.
void check_can_write(const std::filesystem::path& file, const std::filesystem::path& config) {
  const auto refuse = [&](std::string_view why) {
    throw UsageError(fmt::format("--write {}: {}", file.string(), why));
  };
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code ignored;
  if (std::filesystem::equivalent(file, config, ignored))
    refuse("is the config itself, whose /accuracy and /expect would be lost; name another file");
  if (std::filesystem::is_directory(file)) refuse("is a folder; name a file in it");
  if (!std::filesystem::is_directory(folder))
    refuse("its folder does not exist; make it, or name another one");
  if (access(folder.c_str(), W_OK) != 0 || (std::filesystem::exists(file) && access(file.c_str(), W_OK) != 0))
    refuse(fmt::format("cannot be written ({}); choose another place", std::strerror(errno)));
}

void write_config(const Json& config, const std::filesystem::path& file) {
  std::ofstream stream(file);
  stream << config.dump(2) << '\n';
  stream.close();
  if (!stream)
    throw RunFileError(fmt::format("{}: the config cannot be written; choose another place", file.string()));
}

}  // namespace

int advise_command(const AdviseArguments& arguments, const CampaignOptions& campaign, bool json) {
  const AdviceOptions options{
      .demand = demand_of(arguments),
      .error_of = error_of(arguments.what),
      .models = arguments.models,
      .time_limit_s = read_option("--time-limit", arguments.time_limit, parse_duration),
      .campaign = campaign};
  check_models(options.models);
  if (!arguments.write.empty()) check_can_write(arguments.write, arguments.file);
  const Question question(arguments.file, arguments.overrides);
  catch_stop_signals();
  const bool on_terminal = isatty(STDERR_FILENO) != 0;
  const Advice advice = advise(question, options, [&](const std::string& news) {
    if (on_terminal) fmt::print(stderr, "bendlab: {}\n", news);
  });
  if (advice.exit_code != 0) {
    if (stop_exit_code() != 0) fmt::print(stderr, "bendlab: stopped; the same command again goes on\n");
    return advice.exit_code;
  }
  if (json)
    fmt::print("{}\n", advice_json(advice, question, options.demand).dump());
  else
    print_text(advice, question, options.demand);
  if (!advice.best && !arguments.write.empty())
    fmt::print(stderr, "bendlab: {} is not written, as no setting meets the demand\n",
               arguments.write.string());
  if (!advice.best) return exit_failed;
  if (!arguments.write.empty())
    write_config(question.written(advice.best->setting, arguments.write.parent_path()), arguments.write);
  return exit_ok;
}

}  // namespace bendlab
