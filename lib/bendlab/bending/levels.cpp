#include "bendlab/bending/levels.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace bendlab {
namespace {

constexpr double highest_level = 1e5;  // no mesh is so many edges wide

double rounded(double m, Rounding rounding) {
  switch (rounding) {
    case Rounding::floor:
      return std::floor(m);
    case Rounding::round:
      return std::round(m);
    case Rounding::ceil:
      return std::ceil(m);
  }
  throw std::logic_error("levels: unknown rounding");
}

}  // namespace

Levels adaptive_levels(const BendingInput& input, const LevelSettings& settings) {
  return adaptive_levels(input.rest.size(), input.rest.mean_edge_length(), settings);
}

Levels adaptive_levels(double size, double edge, const LevelSettings& settings) {
  const double omega = size / 2 * 0.5, radius = settings.radius;
  Levels levels;
  levels.m_unrounded = radius > 0 ? radius / edge : omega / edge * 0.1 + 1;
  const Rounding rounding = radius > 0 ? Rounding::round : settings.m_rounding;
  levels.m = std::max(static_cast<int>(std::min(highest_level, rounded(levels.m_unrounded, rounding))),
                      settings.m_min);
  levels.n = (2 * levels.m + 1) * settings.n_multiplier;
  if (!settings.pin_zone) levels.n = levels.m;
  return levels;
}

std::vector<int> level_of_vertices(const RestMesh& rest, const Pins& pins, const LevelSettings& settings,
                                   int free_level, int pinned_level) {
  std::vector<int> levels(static_cast<std::size_t>(rest.vertex_count()), free_level);
  const std::vector<int>& counted = settings.pinned_ring_is_pinned ? pins.all : pins.seeds;
  for (const int vertex : counted) levels[static_cast<std::size_t>(vertex)] = pinned_level;
  return levels;
}

std::vector<BendingFact> facts_of(const Levels& levels) {
  return {{"m_unrounded", levels.m_unrounded, "Ω / e_avg · 0.1 + 1, or radius / e_avg"},
          {"m", static_cast<double>(levels.m), "LOD level of free vertices"},
          {"n", static_cast<double>(levels.n), "LOD level of pinned vertices"}};
}

}  // namespace bendlab
