#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "bendlab/bending/model.hpp"
#include "bendlab/io/disk.hpp"
#include "bendlab/scene/defaults.hpp"
#include "bendlab/scene/json_text.hpp"
#include "bendlab/scene/nearest_name.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/advise/advice.hpp"
#include "experiments/advise/reasons.hpp"
#include "experiments/cli/commands.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/signals.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

// Parses the value of an option; a wrong one is a usage error.
template <class Parse>
double read_option(const char* option, const std::string& text, Parse parse) try {
  return parse(text);
} catch (const std::invalid_argument& error) {
  throw UsageError(fmt::format("{}: {}", option, error.what()));
}

Demand demand_of(const AdviseArguments& arguments) {
  if (arguments.error.empty() == arguments.budget.empty())
    throw UsageError(
        "advise needs one of --error 5% (for the fastest settings with that error) and --budget 2ms (for "
        "the most accurate settings with that CPU time per frame)");
  if (!arguments.error.empty()) return {.error = read_option("--error", arguments.error, parse_error)};
  return {.cpu_s = read_option("--budget", arguments.budget, parse_duration)};
}

std::optional<ErrorOf> error_of(const std::string& what) {
  if (what == "rest") return ErrorOf::rest;
  if (what == "motion") return ErrorOf::motion;
  return std::nullopt;
}

void check_names(const char* option, const char* what, const std::vector<std::string>& given,
                 const std::vector<std::string_view>& known) {
  for (const std::string& name : given)
    if (std::ranges::find(known, name) == known.end())
      throw UsageError(fmt::format("{}: there is no {} '{}'{} Choose from: {}", option, what, name,
                                   suggestion(name, known).empty() ? "." : suggestion(name, known),
                                   fmt::join(known, ", ")));
}

void check_models(const std::vector<std::string>& models) {
  std::vector<std::string_view> known;
  for (const BendingKind* model : bending_models()) known.push_back(model->name);
  check_names("--models", "bending model", models, known);
}

void check_methods(const std::vector<std::string>& methods) {
  const std::vector<std::string> advised = advised_methods();
  for (const std::string& name : methods)
    if (find_method(name) != nullptr && std::ranges::find(advised, name) == advised.end())
      throw UsageError(
          fmt::format("--methods: {} is there to be compared with, and is not advised. Choose from: {}", name,
                      fmt::join(advised, ", ")));
  check_names("--methods", "solver method", methods, {advised.begin(), advised.end()});
}

std::string what_text(const Advice& advice, const Question& question) {
  const std::string gap =
      advice.reference.gap ? fmt::format(", which is known to {}", percent_text(*advice.reference.gap)) : "";
  const char* cloth = find_bending_model(question.reference_model())->is_reference
                          ? "calibrated hinges"
                          : "the config's own springs";
  const std::string cells =
      advice.reference.cells > 0 ? fmt::format(" on {} cells", advice.reference.cells) : "";
  switch (advice.reference.of) {
    case ErrorOf::own:
      return fmt::format("against the reference of the config's own /accuracy{}", gap);
    case ErrorOf::motion:
      return fmt::format("of the motion, mean over the frames, against {} with {} substeps{}{}", cloth,
                         advice.reference.substeps, cells, gap);
    case ErrorOf::rest:
      return fmt::format(
          "of the pose at the end, against the static equilibrium of {}{} after the best turn about the "
          "vertical{}",
          cloth, cells,
          advice.reference.start_from_end
              ? "; there are many, and a run is compared with the one near its end"
              : "");
  }
  throw std::logic_error("what_text: unknown kind of error");
}

std::vector<Warning> warnings_of(const Rated& point, const Advice& advice) {
  const auto found = advice.warnings.find(point.setting);
  return found == advice.warnings.end() ? std::vector<Warning>() : found->second;
}

bool is_unconverged(const Rated& point, const Advice& advice) {
  return std::ranges::any_of(warnings_of(point, advice),
                             [](const Warning& w) { return w.code == "unconverged"; });
}

std::string how(const Rated& point, const Advice& advice) {
  const Unfit why = unfit(point);
  if (why != Unfit::no) return fmt::format("unfit: {}", name_of(why));
  return is_unconverged(point, advice) ? "unconverged" : "";
}

std::optional<double> strain_of(const Rated& point, const Advice& advice) {
  const auto found = advice.strain.find(point.setting);
  return found == advice.strain.end() ? std::nullopt : std::optional(found->second);
}

std::string point_text(const Rated& point, const Advice& advice) {
  std::string text =
      fmt::format("{}: {}", setting_text(point.setting),
                  std::isfinite(point.error) ? "error " + percent_text(point.error) : "error not measured");
  if (const auto strain = strain_of(point, advice); unfit(point) != Unfit::no && strain)
    text += fmt::format(", strain {} (rms), a triangle {:.3g} times as long as in the reference",
                        percent_text(*strain), point.strained.largest);
  return text + fmt::format(", {:.3g} ms of CPU per frame", 1e3 * point.cpu_s);
}

// For a shell.
std::string quoted_change(const std::string& change) {
  return change.find_first_of("[]{}\" ") == std::string::npos ? change : "'" + change + "'";
}

// The front; if nothing is fit, what comes nearest. The advised setting is always there.
std::vector<Rated> rows_of(const Advice& advice) {
  std::vector<Rated> rows = thinned(advice.front);
  for (const auto& also : {advice.best, advice.nearest})
    if (also && std::ranges::find(rows, also->setting, &Rated::setting) == rows.end()) rows.push_back(*also);
  std::ranges::stable_sort(rows, {}, &Rated::cpu_s);
  return rows;
}

std::string front_text(const Advice& advice, const Question& question) {
  const int cells = question.cells_that_may_vary();
  Table table({"model", "method", "with", "substeps", "iterations", "cells", "error (%)", "strain (%)",
               "ms per frame", ""});
  for (const Rated& point : rows_of(advice)) {
    const Setting& setting = point.setting;
    const auto strain = strain_of(point, advice);
    table.add_row({setting.model, setting.method, solver_text(setting), std::to_string(setting.substeps),
                   std::to_string(setting.iterations),
                   setting.cells > 0 ? std::to_string(setting.cells)
                   : cells > 0       ? std::to_string(cells)
                                     : "",
                   std::isfinite(point.error) ? percent_number(point.error) : "-",
                   strain ? percent_number(*strain) : "", fmt::format("{:.3g}", 1e3 * point.cpu_s),
                   how(point, advice)});
  }
  return table.text();
}

std::string limits_text() {
  return fmt::format(
      "unfit, never advised: an error above {}, {} more strain (rms) than the reference, or a triangle {} "
      "times as stretched as any of the reference",
      percent_text(largest_error), percent_text(largest_strain), largest_stretch);
}

std::string demand_text(const Demand& demand) {
  return demand.error ? fmt::format("an error of {}", percent_text(*demand.error))
                      : fmt::format("{:.4g} ms of CPU per frame", 1e3 * *demand.cpu_s);
}

// Says that nothing is advised, what came nearest, and why.
void print_none(const Advice& advice, const Question& question, const AdviceOptions& options) {
  const std::string of = advice.not_tried.empty() ? "no setting" : "no setting run so far";
  if (anything_fit(advice))
    print_text("{}: {} meets {}", question.name(), of, demand_text(options.demand));
  else
    print_text("{}: nothing to advise, {} is fit", question.name(), of);
  if (advice.nearest)
    print_text("; nearest is {}{}", point_text(*advice.nearest, advice),
               anything_fit(advice) ? "" : ", which is not to be used");
  print_text("\n");
  for (const std::string& sentence : why_none(advice, options.demand, options.time_limit_s))
    print_text("{}\n", sentence);
}

// How to have the choice.
void print_choice(const Rated& point, const Advice& advice, const Question& question) {
  constexpr double close = 10;
  if (advice.reference.gap && point.error < close * *advice.reference.gap)
    print_text("\n{}\n", point.error > *advice.reference.gap
                             ? "The reference's own error is more than a tenth of this error."
                             : "The reference's own error is as large as this error: settings with less than "
                               "that cannot be told apart. Take a shorter /duration, or a finer reference "
                               "in /accuracy.");
  print_text("\nto use {}:\n", advice.best ? "it" : "the nearest");
  for (const std::string& change : question.changes(point.setting))
    print_text("  --set {}\n", quoted_change(change));
}

void print_not_tried(const Advice& advice, const AdviceOptions& options) {
  if (advice.not_tried.empty()) return;
  constexpr std::size_t shown = 5;
  print_text("\nnot tried, because --time-limit ({:.4g} s) was over; the same command goes on with them:\n",
             options.time_limit_s);
  for (std::size_t i = 0; i < std::min(shown, advice.not_tried.size()); ++i)
    print_text("  {}\n", setting_text(advice.not_tried[i]));
  if (advice.not_tried.size() > shown) print_text("  and {} more\n", advice.not_tried.size() - shown);
}

void print_advice(const Advice& advice, const Question& question, const AdviceOptions& options) {
  if (advice.best)
    print_text("{}: take {}\n", question.name(), point_text(*advice.best, advice));
  else
    print_none(advice, question, options);
  print_text("\nerror: rms {}, in sizes of the mesh\n", what_text(advice, question));
  if (advice.reference.cells > 0)
    print_text(
        "the reference has fewer cells than the config, because more would not fit into --time-limit ({:.4g} "
        "s): "
        "what fewer cells cost is not all in these errors\n",
        options.time_limit_s);
  if (question.rigidity_is_default())
    print_text("cloth: a flexural rigidity of {} N m, the default, because the config states none\n",
               *Bending{}.flexural_rigidity);
  if (!advice.points.empty() && advice.front.empty()) print_text("{}\n", limits_text());
  print_text("\n{}", front_text(advice, question));
  constexpr double at_rest = 0.02;  // sizes per second
  if (advice.reference.of == ErrorOf::rest && advice.reference.still_moving > at_rest)
    print_text(
        "\nThe cloth still moves at the end of /duration, by {} of its size per second: a longer /duration "
        "lets it come to rest, and --what motion compares its motion instead.\n",
        percent_text(advice.reference.still_moving));
  if (const auto& point = advice.best ? advice.best : advice.nearest) {
    for (const Warning& warning : warnings_of(*point, advice))
      print_text("\nIts run warns ({}): {}.\n", warning.code, warning.message);
    if (anything_fit(advice)) print_choice(*point, advice, question);
  }
  print_not_tried(advice, options);
  if (!advice.left_out.empty()) print_text("\nnot in this table:\n");
  for (const LeftOut& left_out : advice.left_out) print_text("  {}: {}\n", left_out.what, left_out.why);
}

Json number_or_null(double number) {
  return std::isfinite(number) ? Json(number) : Json(nullptr);
}

Json setting_json(const Setting& setting) {
  return {{"model", setting.model},
          {"method", setting.method},
          {"solver", Json::parse(setting.solver)},
          {"substeps", setting.substeps},
          {"iterations", setting.iterations},
          {"cells", setting.cells > 0 ? Json(setting.cells) : Json(nullptr)}};
}

Json point_json(const std::optional<Rated>& point, const Advice& advice) {
  if (!point) return nullptr;
  const auto strain = strain_of(*point, advice);
  const Unfit why = unfit(*point);
  Json json = setting_json(point->setting);
  json.update({{"error", number_or_null(point->error)},
               {"strain", strain ? number_or_null(*strain) : Json(nullptr)},
               {"stretch_over_reference", number_or_null(point->strained.largest)},
               {"unfit", why == Unfit::no ? Json(nullptr) : Json(std::string(name_of(why)))},
               {"unconverged", is_unconverged(*point, advice)},
               {"warnings", to_json(warnings_of(*point, advice))},
               {"cpu_s_per_frame", point->cpu_s}});
  return json;
}

Json points_json(const std::vector<Rated>& points, const Advice& advice) {
  Json list = Json::array();
  for (const Rated& point : points) list.push_back(point_json(point, advice));
  return list;
}

Json advice_json(const Advice& advice, const Question& question, const AdviceOptions& options) {
  const Demand& demand = options.demand;
  constexpr const char* kinds[] = {"rest", "motion", "own"};
  Json left_out = Json::array();
  for (const LeftOut& each : advice.left_out) left_out.push_back({{"what", each.what}, {"why", each.why}});
  Json not_tried = Json::array();
  for (const Setting& setting : advice.not_tried) not_tried.push_back(setting_json(setting));
  Json json = {
      {"name", question.name()},
      {"demand", demand.error ? Json{{"error", *demand.error}} : Json{{"cpu_s_per_frame", *demand.cpu_s}}},
      {"error_of", kinds[static_cast<int>(advice.reference.of)]},
      {"many_equilibria", advice.reference.start_from_end},
      {"still_moving", advice.reference.still_moving},
      {"reference_gap", advice.reference.gap ? Json(*advice.reference.gap) : Json(nullptr)},
      {"reference_strain", number_or_null(advice.reference.strain)},
      {"limits",
       {{"error", largest_error},
        {"strain_over_reference", largest_strain},
        {"stretch_over_reference", largest_stretch}}},
      {"accuracy", advice.reference.accuracy},
      {"anything_fit", anything_fit(advice)},
      {"why_none", why_none(advice, demand, options.time_limit_s)},
      {"advice", point_json(advice.best, advice)},
      {"nearest", point_json(advice.nearest, advice)},
      {"set", Json::array()},
      {"front", points_json(advice.front, advice)},
      {"points", points_json(advice.points, advice)},
      {"left_out", left_out},
      {"not_tried", not_tried},
      {"computed_runs", advice.computed},
      {"complete", advice.not_tried.empty()}};
  const auto& point = advice.best ? advice.best : advice.nearest;
  if (point && anything_fit(advice)) json["set"] = question.changes(point->setting);
  return json;
}

// Before anything is computed.
void check_can_write(const std::filesystem::path& file, const std::filesystem::path& config) {
  const auto refuse = [&](std::string_view why) {
    throw UsageError(fmt::format("--write {}: {}", file.string(), why));
  };
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code ignored;
  const std::filesystem::file_status there = std::filesystem::symlink_status(file, ignored);
  if (std::filesystem::equivalent(file, config, ignored))
    refuse("is the config itself, whose /accuracy and /expect would be lost; name another file");
  if (std::filesystem::is_directory(file, ignored)) refuse("is a folder; name a file in it");
  if (std::filesystem::is_symlink(there)) refuse("is a link, which is not followed; name a file");
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
    refuse("is no file; name one");
  if (!std::filesystem::is_directory(folder, ignored))
    refuse("its folder does not exist; create it, or name another one");
  if (access(folder.c_str(), W_OK) != 0 ||
      (std::filesystem::exists(there) && access(file.c_str(), W_OK) != 0))
    refuse(fmt::format("cannot be written ({}); choose another place", std::strerror(errno)));
}

}  // namespace

int advise_command(const AdviseArguments& arguments, const CampaignOptions& campaign, bool json) {
  const AdviceOptions options{
      .demand = demand_of(arguments),
      .error_of = error_of(arguments.what),
      .models = arguments.models,
      .methods = arguments.methods,
      .time_limit_s = read_option("--time-limit", arguments.time_limit, parse_duration),
      .campaign = campaign};
  check_models(options.models);
  check_methods(options.methods);
  if (!arguments.write.empty()) check_can_write(arguments.write, arguments.file);
  const Question question(arguments.file, arguments.overrides);
  catch_stop_signals();
  const bool on_terminal = isatty(STDERR_FILENO) != 0;
  const Advice advice = advise(question, options, [&](const std::string& news) {
    if (on_terminal) print_text(stderr, "bendlab: {}\n", news);
  });
  if (advice.exit_code != 0) {
    if (stop_exit_code() != 0) print_text(stderr, "bendlab: stopped; the same command again continues\n");
    return advice.exit_code;
  }
  if (json)
    print_text("{}\n", json_text(advice_json(advice, question, options)));
  else
    print_advice(advice, question, options);
  if (!advice.best && !arguments.write.empty())
    print_text(stderr, "bendlab: {} is not written, because no setting {}\n", arguments.write.string(),
               anything_fit(advice) ? "meets the demand" : "is fit to be advised");
  if (!advice.best) return exit_failed;
  if (!arguments.write.empty())
    replace_file(arguments.write,
                 question.written(advice.best->setting, arguments.write.parent_path()).dump(2) + '\n');
  return exit_ok;
}

}  // namespace bendlab
