// `bendlab advise`: finds the model, method, substeps, iterations and precision for a scene.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cmath>
#include <stdexcept>

#include "bendlab/bending/model.hpp"
#include "bendlab/io/disk.hpp"
#include "bendlab/scene/json_text.hpp"
#include "bendlab/scene/nearest_name.hpp"
#include "experiments/advise/advice.hpp"
#include "experiments/cli/shared_options.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/signals.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

// Parses the value of an option. A wrong value is a usage error.
template <class Parse>
double read_option(const char* option, const std::string& text, Parse parse) try {
  return parse(text);
} catch (const std::invalid_argument& error) {
  throw UsageError(fmt::format("{}: {}", option, error.what()));
}

struct AdviseCommand : Command {
  std::filesystem::path file;
  std::vector<std::string> overrides;  // "/json/pointer=value"
  std::string error, budget;           // "5%" or "2ms"; exactly one of the two is given
  std::string what = "auto", time_limit = "120s";
  std::vector<std::string> models, methods;  // empty: all that advise can try
  std::filesystem::path write;               // for the advised config; empty: no file
  CampaignOptions campaign;

  AdviseCommand() {
    add(file, "CONFIG", "Config of the scene (JSON), which states the cloth's bending stiffness");
    add(error, "--error 5%", "Find the fastest settings with at most this error, in sizes of the mesh");
    add(budget, "--budget 2ms",
        "Find the most accurate settings with at most this CPU time per frame of 1/60 s");
    add_set(*this, overrides);
    add(what, "--what auto|rest|motion",
        "Which error counts. rest: error of the pose at rest; motion: error of the motion; auto: rest "
        "for a pinned cloth with only loads and damping, motion for other scenes");
    add(models, "--models NAME,...", "Try only these models, separated by commas");
    add(methods, "--methods NAME,...", "Try only these solver methods, separated by commas");
    add(time_limit, "--time-limit",
        "Time limit of the whole search, including the reference: 90s or 5min. Settings that were not "
        "tried in this time are listed");
    add(write, "--write FILE", "Write the config with the advised settings to this file");
    add(campaign.out, "--out", "Folder for the results; the runs go to its subfolder advise");
    add_jobs(*this, campaign);
    add(json, "--json", "Print one JSON object");
  }
  int run() override;
};

Demand demand_of(const AdviseCommand& arguments) {
  if (arguments.error.empty() == arguments.budget.empty())
    throw UsageError(
        "advise needs either --error 5% (to find the fastest settings with at most that error) or --budget "
        "2ms (to find the most accurate settings with at most that CPU time per frame)");
  if (!arguments.error.empty()) return {.error = read_option("--error", arguments.error, parse_error)};
  return {.cpu_s = read_option("--budget", arguments.budget, parse_duration)};
}

void check_names(const char* option, const std::vector<std::string>& given,
                 const std::vector<std::string_view>& known) {
  for (const std::string& name : given)
    if (std::ranges::find(known, name) == known.end())
      throw UsageError(fmt::format("{}: advise cannot try '{}'{} Choose from: {}", option, name,
                                   suggestion(name, known).empty() ? "." : suggestion(name, known),
                                   fmt::join(known, ", ")));
}

void check_names(const AdviceOptions& options) {
  std::vector<std::string_view> models, methods;
  for (const BendingKind* model : bending_models()) models.push_back(model->name);
  for (const SettingKind& kind : measured_fronts())
    if (methods.empty() || methods.back() != kind.setting.method) methods.push_back(kind.setting.method);
  check_names("--models", options.models, models);
  check_names("--methods", options.methods, methods);
}

// ---- as text

// An answer to print.
struct Answer {
  const Advice& advice;
  const Question& question;
  const AdviceOptions& options;
};

std::string error_text(const Answer& answer) {
  const KnownReference& reference = answer.advice.reference;
  const std::string gap =
      reference.gap ? fmt::format(", a reference whose own error is {}", percent_text(*reference.gap)) : "";
  const std::string cloth =
      (find_bending_model(answer.question.reference_model())->is_reference ? "calibrated hinges"
                                                                           : "the config's own springs") +
      (reference.cells > 0 ? fmt::format(" on {} cells", reference.cells) : "");
  if (reference.of == ErrorOf::own)
    return fmt::format("against the reference of the config's own /accuracy{}", gap);
  if (reference.of == ErrorOf::motion)
    return fmt::format("of the motion, mean over the frames, against {} with {} substeps{}", cloth,
                       reference.substeps, gap);
  return fmt::format(
      "of the pose at the end, after the best turn about the vertical, against the static equilibrium of "
      "{}{}",
      cloth,
      reference.start_from_end
          ? "; there are many equilibria, and each run is compared with the equilibrium near its end"
          : "");
}

bool is_unconverged(const Trial& trial) {
  return std::ranges::find(trial.warnings, "unconverged", &Warning::code) != trial.warnings.end();
}

std::string trial_text(const Trial& trial) {
  const bool compared = std::isfinite(trial.error), fit = unfit(trial).empty();
  return fmt::format(
      "{}: {}{}, {:.3g} ms of CPU per frame", setting_text(trial.setting),
      compared ? "error " + percent_text(trial.error) : "error not measured",
      fit ? ""
          : fmt::format(
                ", strain {} (rms), the largest stretch of a triangle {:.3g} times that of the reference",
                percent_text(trial.strain), trial.stretch),
      1e3 * trial.cpu_s);
}

// A table of the front (front_of()) and the advised setting; if no setting is fit, of the nearest setting.
std::string front_text(const Answer& answer) {
  std::vector<Trial> rows = thinned(answer.advice.front);
  if (const auto& choice = answer.advice.choice;
      choice && std::ranges::find(rows, choice->setting, &Trial::setting) == rows.end())
    rows.push_back(*choice);
  std::ranges::stable_sort(rows, {}, &Trial::cpu_s);
  Table table({"model", "method", "with", "substeps", "iterations", "cells", "error (%)", "strain (%)",
               "ms per frame", ""});
  for (const Trial& trial : rows) {
    const Setting& setting = trial.setting;
    const int cells = setting.cells > 0 ? setting.cells : answer.question.cells_that_may_vary();
    table.add_row({setting.model, setting.method, solver_text(setting), std::to_string(setting.substeps),
                   std::to_string(setting.iterations), cells > 0 ? std::to_string(cells) : "",
                   std::isfinite(trial.error) ? percent_number(trial.error) : "-",
                   percent_number(trial.strain), fmt::format("{:.3g}", 1e3 * trial.cpu_s),
                   !unfit(trial).empty()   ? fmt::format("unfit: {}", unfit(trial))
                   : is_unconverged(trial) ? "unconverged"
                                           : ""});
  }
  return table.text();
}

// Prints that no setting is advised, which setting comes nearest, and why.
void print_none(const Answer& answer) {
  const auto& [advice, question, options] = answer;
  const std::string no_setting = advice.not_tried.empty() ? "no setting" : "no setting run so far";
  const Demand& demand = options.demand;
  if (advice.anything_fit())
    print_text("{}: {} meets {}", question.name(), no_setting,
               demand.error ? fmt::format("an error of {}", percent_text(*demand.error))
                            : fmt::format("{:.4g} ms of CPU per frame", 1e3 * *demand.cpu_s));
  else
    print_text("{}: nothing to advise, because {} is fit to be used", question.name(), no_setting);
  if (advice.choice)
    print_text("; the nearest setting is {}{}", trial_text(*advice.choice),
               advice.anything_fit() ? "" : ", which should not be used");
  print_text("\n");
  for (const std::string& sentence : why_none(advice, options)) print_text("{}\n", sentence);
}

// Prints how to use the chosen setting.
void print_choice(const Trial& trial, const Answer& answer) {
  constexpr double close = 10;
  const std::optional<double>& gap = answer.advice.reference.gap;
  if (gap && trial.error < close * *gap)
    print_text(
        "\n{}\n",
        trial.error > *gap
            ? "The reference's own error is more than a tenth of this setting's error."
            : "The reference's own error is at least this setting's error, so settings with such small "
              "errors cannot be compared. Take a shorter /duration, or a finer reference in /accuracy.");
  print_text("\nto use {}:\n", answer.advice.is_met ? "it" : "the nearest setting");
  for (const std::string& change : answer.question.changes(trial.setting))  // quoted for a shell
    print_text("  --set {}\n",
               change.find_first_of("[]{}\" ") == std::string::npos ? change : "'" + change + "'");
}

void print_answer(const Answer& answer) {
  const auto& [advice, question, options] = answer;
  if (advice.is_met)
    print_text("{}: take {}\n", question.name(), trial_text(*advice.choice));
  else
    print_none(answer);
  print_text("\nerror: rms {}, in sizes of the mesh\n", error_text(answer));
  if (advice.reference.cells > 0)
    print_text(
        "the reference has fewer cells than the config, because a reference with more cells would not fit "
        "into --time-limit ({:.4g} s). So the errors contain only a part of the error that fewer cells "
        "cause\n",
        options.time_limit_s);
  if (question.rigidity_is_default())
    print_text("cloth: a flexural rigidity of {} N m, the default, because the config states none\n",
               *Bending{}.flexural_rigidity);
  print_text("\n{}", front_text(answer));
  constexpr double at_rest = 0.02;  // sizes per second
  if (advice.reference.of == ErrorOf::rest && advice.reference.still_moving > at_rest)
    print_text(
        "\nThe cloth still moves at the end of /duration, by {} of its size per second. A longer /duration "
        "lets the cloth come to rest; --what motion compares the motion instead.\n",
        percent_text(advice.reference.still_moving));
  if (const auto& choice = advice.choice) {
    for (const Warning& warning : choice->warnings)
      print_text("\nThe run with this setting has the warning {}: {}.\n", warning.code, warning.message);
    if (advice.anything_fit()) print_choice(*choice, answer);
  }
  constexpr std::size_t most_listed = 5;
  const std::size_t not_tried = advice.not_tried.size();
  if (not_tried > 0)
    print_text(
        "\nnot tried, because the time of --time-limit ({:.4g} s) was over; the same command, run again, "
        "tries these settings:\n",
        options.time_limit_s);
  for (std::size_t i = 0; i < std::min(most_listed, not_tried); ++i)
    print_text("  {}\n", setting_text(advice.not_tried[i]));
  if (not_tried > most_listed) print_text("  and {} more\n", not_tried - most_listed);
  if (!advice.left_out.empty()) print_text("\nnot in this table:\n");
  for (const LeftOut& left_out : advice.left_out) print_text("  {}: {}\n", left_out.what, left_out.why);
}

// ---- as JSON

Json finite_or_null(double number) {
  return std::isfinite(number) ? Json(number) : Json(nullptr);
}

Json to_json(const Setting& setting) {
  return {{"model", setting.model},
          {"method", setting.method},
          {"solver", Json::parse(setting.solver)},
          {"substeps", setting.substeps},
          {"iterations", setting.iterations},
          {"cells", setting.cells > 0 ? Json(setting.cells) : Json(nullptr)}};
}

Json to_json(const Trial& trial) {
  Json json = to_json(trial.setting);
  json.update({{"error", finite_or_null(trial.error)},
               {"strain", finite_or_null(trial.strain)},
               {"stretch_over_reference", finite_or_null(trial.stretch)},
               {"unfit", unfit(trial).empty() ? Json(nullptr) : Json(unfit(trial))},
               {"unconverged", is_unconverged(trial)},
               {"warnings", bendlab::to_json(trial.warnings)},
               {"cpu_s_per_frame", trial.cpu_s}});
  return json;
}

Json to_json(const LeftOut& left_out) {
  return {{"what", left_out.what}, {"why", left_out.why}};
}

template <class Value>
Json list_json(const std::vector<Value>& values) {
  Json list = Json::array();
  for (const Value& value : values) list.push_back(to_json(value));
  return list;
}

Json to_json(const Answer& answer) {
  const auto& [advice, question, options] = answer;
  const KnownReference& reference = advice.reference;
  const Demand& demand = options.demand;
  constexpr const char* kinds[] = {"rest", "motion", "own"};
  const Json choice = advice.choice ? to_json(*advice.choice) : Json(nullptr);
  return {
      {"name", question.name()},
      {"demand", demand.error ? Json{{"error", *demand.error}} : Json{{"cpu_s_per_frame", *demand.cpu_s}}},
      {"error_of", kinds[static_cast<int>(reference.of)]},
      {"many_equilibria", reference.start_from_end},
      {"still_moving", reference.still_moving},
      {"reference_gap", reference.gap ? Json(*reference.gap) : Json(nullptr)},
      {"reference_strain", finite_or_null(reference.strain)},
      {"limits",
       {{"error", largest_error},
        {"strain_over_reference", largest_strain},
        {"stretch_over_reference", largest_stretch}}},
      {"accuracy", reference.accuracy},
      {"anything_fit", advice.anything_fit()},
      {"why_none", why_none(advice, options)},
      {"advice", advice.is_met ? choice : Json(nullptr)},
      {"nearest", advice.is_met ? Json(nullptr) : choice},
      {"set", advice.choice && advice.anything_fit() ? Json(question.changes(advice.choice->setting))
                                                     : Json::array()},
      {"front", list_json(advice.front)},
      {"points", list_json(advice.trials)},
      {"left_out", list_json(advice.left_out)},
      {"not_tried", list_json(advice.not_tried)},
      {"computed_runs", advice.computed},
      {"complete", advice.not_tried.empty()}};
}

// Checks, before anything is computed, that the file of --write can be written.
void check_can_write(const std::filesystem::path& file, const std::filesystem::path& config) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::file_status there = fs::symlink_status(file, ignored);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const char* why = nullptr;
  if (fs::equivalent(file, config, ignored))
    why = "is the config itself, which would lose its /accuracy and /expect; name another file";
  else if (fs::is_directory(file, ignored))
    why = "is a folder; name a file in it";
  else if (fs::is_symlink(there))
    why = "is a link, and links are never overwritten; name a file";
  else if (fs::exists(there) && !fs::is_regular_file(there))
    why = "is not a regular file; name another file";
  else if (!fs::is_directory(folder, ignored))
    why = "its folder does not exist; create the folder, or name another file";
  else if (access(folder.c_str(), W_OK) != 0 || (fs::exists(there) && access(file.c_str(), W_OK) != 0))
    why = "cannot be written; name another file, or change the permissions";
  if (why) throw UsageError(fmt::format("--write {}: {}", file.string(), why));
}

int AdviseCommand::run() {
  const AdviceOptions options{.demand = demand_of(*this),
                              .error_of = what == "rest"     ? std::optional(ErrorOf::rest)
                                          : what == "motion" ? std::optional(ErrorOf::motion)
                                                             : std::nullopt,
                              .models = models,
                              .methods = methods,
                              .time_limit_s = read_option("--time-limit", time_limit, parse_duration),
                              .campaign = campaign};
  check_names(options);
  if (!write.empty()) check_can_write(write, file);
  const Question question(file, overrides);
  catch_stop_signals();
  const bool on_terminal = isatty(STDERR_FILENO) != 0;
  const Advice advice = advise(question, options, [&](const std::string& news) {
    if (on_terminal) print_text(stderr, "bendlab: {}\n", news);
  });
  if (advice.exit_code != 0) {
    if (stop_exit_code() != 0)
      print_text(stderr, "bendlab: stopped; run the same command again to continue\n");
    return advice.exit_code;
  }
  const Answer answer{advice, question, options};
  if (json)
    print_text("{}\n", json_text(to_json(answer)));
  else
    print_answer(answer);
  if (!advice.is_met && !write.empty())
    print_text(stderr, "bendlab: {} is not written, because no setting {}\n", write.string(),
               advice.anything_fit() ? "meets the demand" : "is fit to be used");
  if (advice.is_met && !write.empty())
    replace_file(write, question.written(advice.choice->setting, write.parent_path()).dump(2) + '\n');
  return advice.is_met ? exit_ok : exit_failed;
}

}  // namespace

extern const CommandKind advise_command{
    "advise", "Find the model, method, substeps, iterations and precision for a scene",
    "bendlab advise configs/advise/strip.json --error 5%", make<AdviseCommand>};

}  // namespace bendlab
