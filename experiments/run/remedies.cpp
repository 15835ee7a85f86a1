#include "experiments/run/remedies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bendlab/solver/method.hpp"

namespace bendlab {
namespace {

// Whether any spring is longer at rest than the distance of its vertices in the rest shape.
bool is_prestressed(const BuiltScene& scene) {
  constexpr double longer = 1.001;
  const DistanceConstraints& springs = scene.input.distance;
  for (std::size_t c = 0; c < springs.size(); ++c) {
    const auto [a, b] = springs.vertices[c];
    if (springs.rest(c) > longer * (scene.rest.position(a) - scene.rest.position(b)).norm()) return true;
  }
  return false;
}

}  // namespace

std::string remedies_for(Bound bound, const BuiltScene& scene) {
  const Method& method = scene.input.method;
  if (method.kind().remedies == nullptr) return "";
  const auto helps = [](const Effect& effect) { return effect.kind().helps_projection; };
  const std::vector<std::string> texts = method.kind().remedies(
      method.settings(), {.input = scene.input,
                          .fell_wrong = bound == Bound::momentum || bound == Bound::fall,
                          .single_precision = scene.precision == Precision::single_precision,
                          .is_pinned = !scene.pins.all.empty(),
                          .helps_projection = std::ranges::any_of(scene.effects, helps),
                          .is_prestressed = is_prestressed(scene)});
  return fmt::format("{}", fmt::join(texts, "; "));
}

}  // namespace bendlab
