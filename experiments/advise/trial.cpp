#include "experiments/advise/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <tuple>

#include "bendlab/scene/counted.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {
namespace {

// The number in `text` times the value of its unit. Nothing for a number of at most 0 or an unknown unit.
std::optional<double> parse_quantity(const std::string& text,
                                     std::initializer_list<std::pair<std::string_view, double>> units) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  while (*end == ' ') ++end;
  for (const auto& [unit, worth] : units)
    if (unit == end && number > 0 && std::isfinite(number)) return number * worth;
  return std::nullopt;
}

// The largest ratio of strain, stretch and error to their limits. If the strain was too large for a
// comparison with the reference, only strain and stretch count.
double beyond_limits(const Trial& trial) {
  return std::max({trial.more_strain / largest_strain, (trial.stretch - 1) / (largest_stretch - 1),
                   std::isfinite(trial.error) ? trial.error / largest_error : 0});
}

}  // namespace

const std::vector<SettingKind>& measured_fronts() {
  static const std::vector<SettingKind> fronts = {
#include "experiments/advise/fronts.def"
  };
  return fronts;
}

std::string solver_text(const Setting& setting) {
  std::string text;
  const Json settings = Json::parse(setting.solver);
  for (const auto& [name, value] : settings.items())
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name,
                        value.is_string() ? value.get<std::string>() : value.dump());
  return text;
}

std::string setting_text(const Setting& setting) {
  const std::string solver = solver_text(setting);
  return fmt::format("{}, {}{}, {}, {}{}", setting.model, setting.method,
                     solver.empty() ? "" : fmt::format(" ({})", solver), counted(setting.substeps, "substep"),
                     counted(setting.iterations, "iteration"),
                     setting.cells > 0 ? ", " + counted(setting.cells, "cell") : "");
}

double parse_error(const std::string& text) {
  const std::optional<double> error = parse_quantity(text, {{"%", 0.01}, {"", 1}});
  if (error && *error < 1) return *error;
  throw std::invalid_argument(fmt::format(
      "'{}' is not an error between 0 and 1: write a share of the cloth's size, such as 5% or 0.05", text));
}

double parse_duration(const std::string& text) {
  if (const auto seconds = parse_quantity(text, {{"us", 1e-6}, {"ms", 1e-3}, {"s", 1}, {"min", 60}}))
    return *seconds;
  throw std::invalid_argument(fmt::format(
      "'{}' is not a time: write a number above 0 and its unit (us, ms, s, min), such as 2ms or 0.002s",
      text));
}

std::string percent_number(double share) {
  constexpr double three_digits = 0.995;
  return share < three_digits ? fmt::format("{:.2g}", 100 * share) : fmt::format("{:.0f}", 100 * share);
}

std::string percent_text(double share) {
  return percent_number(share) + " %";
}

std::string_view unfit(const Trial& trial) {
  if (trial.implausible) return "implausible";
  if (!(trial.more_strain <= largest_strain)) return "strain";
  if (!(trial.stretch <= largest_stretch)) return "stretch";
  return trial.error <= largest_error ? "" : "error";
}

double judged_error(const Trial& trial) {
  return unfit(trial).empty() ? trial.error : largest_error * std::max(1.0, beyond_limits(trial));
}

double score(const Trial& trial, const Demand& demand) {
  const double error = judged_error(trial);
  return demand.error ? trial.cpu_s * std::max(1.0, error / *demand.error)
                      : error * std::max(1.0, trial.cpu_s / *demand.cpu_s);
}

bool meets(const Trial& trial, const Demand& demand) {
  return unfit(trial).empty() && (demand.error ? trial.error <= *demand.error : trial.cpu_s <= *demand.cpu_s);
}

std::optional<Trial> choice_of(std::span<const Trial> trials, const Demand& demand) {
  const auto rank = [&](const Trial& trial) {
    const bool meeting = meets(trial, demand);
    if (!unfit(trial).empty()) {
      const bool slow = demand.cpu_s && trial.cpu_s > *demand.cpu_s;
      return std::tuple(slow ? 3 : 2, beyond_limits(trial), trial.cpu_s);
    }
    return meeting == demand.error.has_value() ? std::tuple(meeting ? 0 : 1, trial.cpu_s, trial.error)
                                               : std::tuple(meeting ? 0 : 1, trial.error, trial.cpu_s);
  };
  return trials.empty() ? std::nullopt : std::optional(*std::ranges::min_element(trials, {}, rank));
}

std::vector<Trial> front_of(std::span<const Trial> trials) {
  std::vector<Trial> sorted(trials.begin(), trials.end()), front;
  std::ranges::stable_sort(sorted, {},
                           [](const Trial& trial) { return std::tuple(trial.cpu_s, trial.error); });
  for (const Trial& trial : sorted)
    if (unfit(trial).empty() && (front.empty() || trial.error < front.back().error)) front.push_back(trial);
  return front;
}

std::vector<Trial> thinned(std::span<const Trial> front) {
  constexpr double much_better = 0.9;
  std::vector<Trial> kept;
  for (const Trial& trial : front)
    if (kept.empty() || trial.error <= much_better * kept.back().error || &trial == &front.back())
      kept.push_back(trial);
  return kept;
}

}  // namespace bendlab
