#include "experiments/run/broken_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bendlab {
namespace {

constexpr std::array<std::string_view, 8> bound_names = {"finite", "stretch",  "mean_strain", "reach",
                                                         "speed",  "momentum", "fall",        "energy"};
constexpr std::array<std::string_view, 8> bound_units = {"1", "1", "1", "m", "m/s", "m/s", "m", "J"};

// States which bound the run broke, by how much and where.
std::string what_broke(const BrokenBound& broken) {
  const auto& [bound, measured, limit, time, vertex, correction, advice] = broken;
  switch (bound) {
    case Bound::finite:
      if (vertex < 0) return "the summary has metrics that are not finite";
      return fmt::format("the position or the velocity of vertex {} is not finite", vertex);
    case Bound::stretch:
      return fmt::format(
          "the most stretched triangle, at vertex {}, is {:.3g} times as long as at rest, but the cloth "
          "cannot stretch more than {:.3g} times",
          vertex, measured, limit);
    case Bound::mean_strain:
      return fmt::format("the mean strain is {:.3g}, but in this cloth it cannot be more than {:.3g}",
                         measured, limit);
    case Bound::reach:
      return fmt::format(
          "vertex {} is {:.3g} m away from its nearest pin, but the cloth between vertex and pin stretches "
          "to at most {:.3g} m",
          vertex, measured, limit);
    case Bound::speed:
      return fmt::format("vertex {} moves at {:.3g} m/s, but the deepest possible fall gives at most {:.3g}",
                         vertex, measured, limit);
    case Bound::momentum:
      return fmt::format(
          "the velocity of the centre of mass differs by {:.3g} m/s from v0 + g t, but rounding explains at "
          "most {:.3g}",
          measured, limit);
    case Bound::fall:
      return fmt::format(
          "the centre of mass is {:.3g} m away from v0 t + g t²/2, but rounding explains at most {:.3g}",
          measured, limit);
    case Bound::energy:
      return fmt::format(
          "kinetic energy plus energy of weight is {:.3g} J above its value at the start, but solver errors "
          "explain at most {:.3g}",
          measured, limit);
  }
  return std::string();
}

double number_in(const Json& json, const char* key) {
  const auto value = json.find(key);
  return value != json.end() && value->is_number() ? value->get<double>()
                                                   : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::string_view name_of(Bound bound) {
  return bound_names.at(static_cast<std::size_t>(bound));
}

std::string_view unit_of(Bound bound) {
  return bound_units.at(static_cast<std::size_t>(bound));
}

std::string text_of(const BrokenBound& broken) {
  const Correction& correction = broken.correction;
  const std::string cause = correction.kind.empty() ? ""
                                                    : fmt::format(
                                                          "; of the constraints at this vertex, a constraint "
                                                          "of kind {} has the largest correction, {:.3g} m",
                                                          correction.kind, correction.length);
  return fmt::format("at t = {:.6g} s {}{}{}{}", broken.time, what_broke(broken), cause,
                     broken.advice.empty() ? "" : ". In tests of other scenes, this helped: ", broken.advice);
}

Json to_json(const BrokenBound& broken) {
  return {{"bound", name_of(broken.bound)},
          {"measured", broken.measured},
          {"limit", broken.limit},
          {"unit", unit_of(broken.bound)},
          {"time", broken.time},
          {"vertex", broken.vertex},
          {"constraint", {{"kind", broken.correction.kind}, {"correction", broken.correction.length}}},
          {"advice", broken.advice}};
}

std::optional<BrokenBound> broken_bound_of(const Json& json) try {
  const auto name = std::ranges::find(bound_names, json.at("bound").get<std::string>());
  const Json& vertex = json.at("vertex");  // 1e300 does not fit into an int
  if (name == bound_names.end() || !vertex.is_number_integer()) return std::nullopt;
  return BrokenBound{.bound = static_cast<Bound>(name - bound_names.begin()),
                     .measured = number_in(json, "measured"),
                     .limit = number_in(json, "limit"),
                     .time = number_in(json, "time"),
                     .vertex = vertex.get<int>(),
                     .correction = {json.at("constraint").at("kind").get<std::string>(),
                                    number_in(json.at("constraint"), "correction")},
                     .advice = json.at("advice").get<std::string>()};
} catch (const Json::exception&) {
  return std::nullopt;
}

}  // namespace bendlab
