#include "bendlab/scene/fabric_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "bendlab/bending/directed_rigidity.hpp"
#include "bendlab/scene/fabrics.hpp"
#include "bendlab/settings/input_file.hpp"
#include "bendlab/settings/measured_lines.hpp"

namespace bendlab {
namespace {

constexpr double slope_from = 0.5, slope_to = 1.5, hysteresis_at = 1;  // 1/cm, of KES-FB2

// Points of a branch, in the order of ascending |K|.
using Branch = std::vector<std::array<double, 2>>;

double moment_at(const Branch& branch, double curvature) {
  const auto next = std::ranges::lower_bound(branch, curvature, {}, [](const auto& p) { return p[0]; });
  if (next == branch.begin() || next == branch.end())
    throw std::invalid_argument(fmt::format(
        "the curve does not reach {} /cm: bend the specimen to 2.5 /cm on both sides", curvature));
  const auto& low = *std::prev(next);
  return low[1] + (curvature - low[0]) / ((*next)[0] - low[0]) * ((*next)[1] - low[1]);
}

double slope_of(const Branch& branch) {
  double n = 0, k = 0, m = 0, kk = 0, km = 0;
  for (const auto& [curvature, moment] : branch) {
    if (curvature < slope_from || curvature > slope_to) continue;
    n += 1, k += curvature, m += moment, kk += curvature * curvature, km += curvature * moment;
  }
  if (n < 3)
    throw std::invalid_argument(fmt::format(
        "bending or unbending to one side has {} points between {} and {} /cm, but a slope needs 3: the file "
        "has to have the whole loop, to 2.5 /cm on both sides and back",
        n, slope_from, slope_to));
  return (n * km - k * m) / (n * kk - k * k);
}

}  // namespace

BendingMeasurement kes_bending(const std::filesystem::path& file) {
  // A side of the curve (K above or below 0) has a branch of bending (|K| grows) and a branch of unbending.
  std::array<std::array<Branch, 2>, 2> branches;  // by side, then bending or unbending
  std::optional<std::array<double, 2>> before;
  double farthest = 0;  // 1/cm
  const std::string text = read_input_file(file);
  for_measured_lines(text, [&](const std::vector<std::string_view>& words, int line) {
    const auto curvature = number_in(words[0]),
               moment = words.size() > 1 ? number_in(words[1]) : std::nullopt;
    if (!before && !curvature) return;  // titles of the columns
    if (words.size() != 2 || !curvature || !moment)
      throw std::invalid_argument(
          fmt::format("line {} has not two numbers: a curve has two columns, the curvature in 1/cm and the "
                      "moment in gf cm/cm, with decimal points",
                      line));
    farthest = std::max(farthest, std::abs(*curvature));
    if (before && *curvature != 0) {
      const std::size_t side = *curvature > 0 ? 0 : 1,
                        unbends = std::abs(*curvature) < std::abs((*before)[0]);
      const double sign = side == 0 ? 1 : -1;
      branches[side][unbends].push_back({std::abs(*curvature), sign * *moment});
    }
    before = {*curvature, *moment};
  });
  if (!before) throw std::invalid_argument("there are no numbers: expected lines such as '0.5 0.061'");
  constexpr double bent_too_far = 25;  // 1/cm; the instrument bends to 2.5
  if (farthest > bent_too_far)
    throw std::invalid_argument(
        fmt::format("the curvature goes to {:.3g} /cm, but KES-FB2 bends to 2.5 /cm: is the first column in "
                    "1/m? Divide it by 100",
                    farthest));
  BendingMeasurement result;
  double slope = 0, width = 0;
  for (auto& side : branches)
    for (std::size_t unbends : {0U, 1U}) {
      std::ranges::stable_sort(side[unbends], {}, [](const auto& p) { return p[0]; });
      slope += slope_of(side[unbends]) / 4;
      width += (unbends ? -0.5 : 0.5) * moment_at(side[unbends], hysteresis_at);
    }
  result.rigidity = slope * gf_cm2_per_cm;
  result.friction = width / 2 * gf_cm_per_cm;
  if (width < 0)
    throw std::invalid_argument(
        "unbending needs a larger moment than bending, but friction makes it smaller: are the lines in the "
        "order of the measurement?");
  if (!(result.rigidity > 0))
    throw std::invalid_argument(
        fmt::format("the slope of the curve is {:.3g} gf cm²/cm, but a rigidity is above 0: "
                    "the first column has to be the curvature in 1/cm",
                    slope));
  return result;
}

std::vector<BendingLengths> astm_bending_lengths(const std::filesystem::path& file) {
  std::map<std::string, std::vector<double>> overhangs;
  const std::string text = read_input_file(file);
  for_measured_lines(text, [&](const std::vector<std::string_view>& words, int line) {
    const auto overhang = words.size() > 1 ? number_in(words[1]) : std::nullopt;
    if (!overhang && line == 1) return;  // titles of the columns
    if (words.size() > 2)
      throw std::invalid_argument(
          fmt::format("line {}: expected a direction and one overhang in mm, with a decimal point", line));
    std::string direction(words[0]);
    if (!overhang || !(*overhang > 0) || (direction != "warp" && direction != "weft" && direction != "bias"))
      throw std::invalid_argument(
          fmt::format("line {}: expected warp, weft or bias, and the overhang in mm, above 0", line));
    overhangs[direction].push_back(*overhang * 1e-3);
  });
  if (overhangs.empty())
    throw std::invalid_argument("no measurement: expected lines such as 'warp 52.5', the overhang in mm");
  std::vector<BendingLengths> result;
  for (const auto& [direction, values] : overhangs) {
    BendingLengths lengths{direction, 0, 0, values.size()};
    const auto n = static_cast<double>(values.size());
    for (const double value : values) lengths.length += 0.5 * value / n;
    double squares = 0;
    for (const double value : values) squares += std::pow(0.5 * value - lengths.length, 2);
    lengths.uncertainty = n > 1 ? std::sqrt(squares / (n - 1) / n) : 0;
    result.push_back(lengths);
  }
  return result;
}

Json arcsim_settings(const std::filesystem::path& file) {
  constexpr double of_hinge = 0.25;  // B / k on equilateral triangles
  const Json json = Json::parse(read_input_file(file), nullptr, false, true);
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument(what +
                                ": expected \"density\" in kg/m² and \"bending\", 3 lists of 5 stiffnesses");
  };
  if (json.is_discarded() || !json.is_object()) fail("this is no JSON object");
  if (!json.contains("density") || !json["density"].is_number()) fail("\"density\" is missing");
  const Json bending = json.value("bending", Json());
  if (!bending.is_array() || bending.size() != 3) fail("\"bending\" does not have 3 lists");
  std::array<double, 3> first{};
  for (std::size_t row = 0; row < 3; ++row) {
    if (!bending[row].is_array() || bending[row].size() != 5 || !bending[row][0].is_number())
      fail(fmt::format("list {} of \"bending\" does not have 5 numbers", row + 1));
    first[row] = of_hinge * bending[row][0].get<double>();
  }
  if (!(std::ranges::min(first) > 0)) fail("a stiffness at the smallest curvature is not above 0");
  // The angle is that of the edge. An edge along the warp (0°) is an axis of bending of the weft.
  orthotropic_rigidity(first[2], first[0], first[1], 0);  // refuses a bias that no sheet has
  return {{"material", {{"density", json["density"]}}},
          {"bending", {{"rigidity", {{"warp", first[2]}, {"weft", first[0]}, {"bias", first[1]}}}}}};
}

}  // namespace bendlab
