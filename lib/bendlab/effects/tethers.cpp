// Tethers: the distance from a vertex to a pin is at most the length of cloth between vertex and pin.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "bendlab/effects/effects.hpp"
#include "bendlab/mesh/geodesics.hpp"

namespace bendlab {
namespace tethers_effect {

constexpr std::array<std::string_view, 2> distance_names = {"geodesic", "straight"};

constexpr std::array fields = {
    field<&Tethers::per_vertex>(
        {.name = "per_vertex",
         .unit = "1",
         .meaning =
             "largest number of tethers of a vertex. Each tether goes to the nearest vertex of a connected "
             "group of pins; the nearest groups come first",
         .minimum = 1,
         .maximum = 64}),
    field<&Tethers::slack>(
        {.name = "slack",
         .unit = "1",
         .meaning = "the length of a tether is 1 + slack times the length of cloth between vertex and pin",
         .minimum = 0}),
    field<&Tethers::distance>(
        {.name = "distance",
         .meaning = "how the length of cloth between vertex and pin is measured: geodesic (along the rest "
                    "surface) or straight (too short if the rest shape is curved or has holes)",
         .choices = distance_names}),
};

struct Tether {
  std::size_t vertex, pin;  // permuted
  double length;            // m
};

// The connected groups of pins.
std::vector<std::vector<int>> groups_of(const RestMesh& rest, const Pins& pins) {
  std::vector<std::vector<int>> groups;
  std::vector<char> seen(static_cast<std::size_t>(rest.vertex_count()), 0);
  for (const int first : pins.all) {
    if (seen[static_cast<std::size_t>(first)]) continue;
    std::vector<int> group{first};
    seen[static_cast<std::size_t>(first)] = 1;
    for (std::size_t i = 0; i < group.size(); ++i)
      for (const int next : rest.one_ring()[group[i]])
        if (pins.pinned(next) && !std::exchange(seen[static_cast<std::size_t>(next)], 1))
          group.push_back(next);
    groups.push_back(std::move(group));
  }
  return groups;
}

GeodesicDistances straight_distances(const RestMesh& rest, std::span<const int> sources) {
  GeodesicDistances result;
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const auto distance = [&](int source) { return (rest.position(v) - rest.position(source)).norm(); };
    const int nearest = *std::ranges::min_element(sources, {}, [&](int source) { return distance(source); });
    result.distance.push_back(distance(nearest)), result.source.push_back(nearest);
  }
  return result;
}

// Ordered by vertex. The tether to the nearest pin is the last of its vertex, so it is satisfied exactly.
std::vector<Tether> tethers_of(const Tethers& settings, const EffectInput& input) {
  const bool straight = settings.distance == Tethers::Distance::straight;
  std::vector<GeodesicDistances> from;
  for (const std::vector<int>& group : groups_of(input.rest, input.pins))
    from.push_back(straight ? straight_distances(input.rest, group) : geodesic_distances(input.rest, group));
  const auto most = static_cast<std::size_t>(settings.per_vertex);
  const double longer = 1 + settings.slack;
  std::vector<Tether> tethers;
  for (int v = 0; v < input.rest.vertex_count(); ++v) {
    if (input.pins.pinned(v)) continue;
    std::vector<Tether> own;
    for (const GeodesicDistances& group : from)
      if (const int pin = group.source[static_cast<std::size_t>(v)]; pin >= 0)
        own.push_back(
            {input.permuted(v), input.permuted(pin), longer * group.distance[static_cast<std::size_t>(v)]});
    std::ranges::sort(own, {}, &Tether::length);
    own.resize(std::min(own.size(), most));
    tethers.insert(tethers.end(), own.rbegin(), own.rend());
  }
  return tethers;
}

template <class Real>
std::vector<Pass<Real>> compile(const Tethers& settings, const EffectInput& input) {
  const auto tethers = std::make_shared<const std::vector<Tether>>(tethers_of(settings, input));
  if (tethers->empty()) return {};
  return {{"tethers", Stage::project, [tethers](PassContext<Real>& context) {
             Points<Real>& points = context.state.position;
             for (const Tether& tether : *tethers) {
               Point<Real>& p = points[tether.vertex];
               const Vector3Of<Real> pin = points[tether.pin].vector(), offset = p.vector() - pin;
               const Real length = static_cast<Real>(tether.length), squared = offset.squaredNorm();
               if (!(squared > length * length)) continue;
               p.set(pin + length / std::sqrt(squared) * offset);
               ++context.acted;
             }
           }}};
}

}  // namespace tethers_effect

constinit const EffectKind Tethers::kind{
    .name = "tethers",
    .summary =
        "long-range attachments: the distance from a vertex to a pin is at most the length of cloth between "
        "vertex and pin",
    .source = "Kim, Chentanez and Müller-Fischer 2012, §3",
    .settings = table_of<Tethers>(tethers_effect::fields),
    .needs_projection = true,
    .helps_projection = true,
    .needs_pins = true,
    .keeps_momentum = true,
    .bounds_strain = true,
    .compile_float = erased<tethers_effect::compile<float>>,
    .compile_double = erased<tethers_effect::compile<double>>,
};
}  // namespace bendlab
