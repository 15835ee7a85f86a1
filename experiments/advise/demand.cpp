#include "experiments/advise/demand.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace bendlab {
namespace {

struct Quantity {
  double number;
  std::string unit;
};

// Nothing where the text does not begin with a finite number.
std::optional<Quantity> read_quantity(std::string_view text) {
  const std::string copy(text);
  char* end = nullptr;
  const double number = std::strtod(copy.c_str(), &end);
  if (end == copy.c_str() || !std::isfinite(number)) return std::nullopt;
  std::string unit(end);
  unit.erase(0, unit.find_first_not_of(' '));
  return Quantity{number, unit};
}

constexpr std::array<std::pair<std::string_view, double>, 4> units = {
    {{"us", 1e-6}, {"ms", 1e-3}, {"s", 1.0}, {"min", 60.0}}};

}  // namespace

double parse_error(std::string_view text) {
  const std::optional<Quantity> read = read_quantity(text);
  if (!read || (read->unit != "%" && !read->unit.empty()))
    throw std::invalid_argument(
        fmt::format("'{}' is no error: write a share of the cloth's size, 5% or 0.05", text));
  const double error = read->unit == "%" ? read->number / 100 : read->number;
  if (!(error > 0 && error < 1))
    throw std::invalid_argument(
        fmt::format("'{}' is no error between 0 and 1: write a share of the cloth's size, 5% or 0.05", text));
  return error;
}

double parse_duration(std::string_view text) {
  const std::optional<Quantity> read = read_quantity(text);
  if (read && read->number > 0)
    for (const auto& [unit, seconds] : units)
      if (read->unit == unit) return read->number * seconds;
  throw std::invalid_argument(fmt::format(
      "'{}' is no time: write a number above 0 and its unit (us, ms, s, min), 2ms or 0.002s", text));
}

std::string percent_number(double share) {
  constexpr double three_digits = 0.995;
  return share < three_digits ? fmt::format("{:.2g}", 100 * share) : fmt::format("{:.0f}", 100 * share);
}

std::string percent_text(double share) {
  return percent_number(share) + " %";
}

}  // namespace bendlab
