// Wind: aerodynamic lift and drag on every triangle.
//
//          n        u: velocity of the triangle relative to the air, n: its normal, c = n·u / |u|
//          |   u    drag  -½ ρ C_D A |c| |u| u                  against u; A |c|: area as seen along u
//     _____|__/     lift  -½ ρ C_L A c (|u|² n - (n·u) u)       perpendicular to u
//         A         A: the triangle's area now
//
// |u|² n - (n·u) u = u × (n × u) is Wilson et al.'s direction of lift. Wilson et al. do not multiply the lift
// by c. So their lift is largest if the air flows along the cloth, and changes its sign suddenly if the cloth
// turns through this position. With the factor c (Keckeisen et al. 2004) the lift is zero at this position.
//
// With an explicit impulse h F, a strong wind would give a light triangle a velocity beyond the velocity of
// the air, and the error would grow in each substep. So the impulse is bounded. Let m be the triangle's part
// of its corners' masses, and D and L the sizes of drag and lift. |u + s h F / m| is least at s = m |u| D /
// (h (D² + L²)). The impulse is h F times the smaller of s and 1, so |u| does not grow. The change of a
// vertex's velocity is the mean, weighted by mass, of the changes that its triangles would have if they were
// separate. So, by Jensen's inequality, the kinetic energy of a free cloth relative to a steady uniform wind
// does not grow for any h. If s ≥ 1, which means (D² + L²) / D ≤ m |u| / h, the force is not bounded and
// follows the law exactly.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "bendlab/constraints/build.hpp"
#include "bendlab/effects/effects.hpp"
#include "bendlab/effects/gusts.hpp"

namespace bendlab {
namespace wind_effect {

constexpr std::array fields = {
    field<&Wind::velocity>(
        {.name = "velocity",
         .unit = "m/s",
         .meaning = "mean velocity of the air; 0, 0, 0 is air at rest. Wind acts before all other effects, "
                    "on the velocities at the start of the substep; its place in the list does not matter. "
                    "So terminal velocities are exact, except if the cloth gains more than its terminal "
                    "velocity in one substep"}),
    field<&Wind::air_density>({.name = "air_density",
                               .unit = "kg/m³",
                               .meaning = "density of the air, ρ; the default is dry air at 20 °C and 101325 "
                                          "Pa",
                               .minimum = 0}),
    field<&Wind::drag_coefficient>(
        {.name = "drag_coefficient",
         .unit = "1",
         .meaning = "drag coefficient C_D; a flat plate across the flow has 1.28 (NASA Glenn, kite "
                    "aerodynamics)",
         .minimum = 0,
         .above = true}),
    field<&Wind::lift_coefficient>(
        {.name = "lift_coefficient",
         .unit = "1",
         .meaning = "lift coefficient C_L. The lift is greatest at 45 degrees; there it equals the lift of a "
                    "wing with the coefficient C_L/2",
         .minimum = 0}),
    field<&Wind::gust_amplitude>(
        {.name = "gust_amplitude",
         .unit = "1",
         .meaning =
             "standard deviation of each component of the air's velocity, as a fraction of the mean speed "
             "(turbulence intensity); no component deviates by more than 2.01 times this fraction",
         .minimum = 0}),
    field<&Wind::gust_time>(
        {.name = "gust_time",
         .unit = "s",
         .meaning = "time from one gust to the next; successive gusts are independent of each other",
         .minimum = 0,
         .above = true}),
    field<&Wind::gusts_travel>({.name = "gusts_travel",
                                .meaning = "true: gusts move with the mean velocity (Taylor's frozen "
                                           "turbulence); false: the air has the same velocity everywhere"}),
    field<&Wind::seed>({.name = "seed",
                        .unit = "1",
                        .meaning = "seed of the gusts; the same seed gives the same bits",
                        .minimum = 0}),
};

struct Air {
  Vector3 mean;  // m/s
  Gusts gusts;
  bool travel;

  explicit Air(const Wind& settings)
      : mean(settings.velocity),
        gusts{settings.gust_amplitude * mean.norm(), settings.gust_time, settings.seed},
        travel(settings.gusts_travel && gusts.deviation > 0) {}

  Vector3 velocity_at(double time) const {
    return gusts.deviation > 0 ? Vector3(mean + gusts.at(time)) : mean;
  }
  // The air that is at `point` now was in the plane through the world's origin, perpendicular to the wind, a
  // time point·mean / |mean|² ago.
  Vector3 velocity_at(double time, const Vector3& point) const {
    return velocity_at(time - point.dot(mean) / mean.squaredNorm());
  }
};

template <class Real>
class Blowing {
  using Vector = Vector3Of<Real>;

  struct Triangle {
    std::array<std::uint32_t, 3> corners;  // permuted
    std::array<Real, 3> share;             // of each corner's mass: the triangle's part of the corner's area
  };

  Air air_;
  Real drag_, lift_;  // ½ ρ C, kg/m³
  std::vector<Triangle> triangles_;
  std::vector<Vector> impulse_;  // #V, N s

 public:
  Blowing(const Wind& settings, const EffectInput& input)
      : air_(settings), impulse_(static_cast<std::size_t>(input.rest.vertex_count())) {
    const double half_density = 0.5 * settings.air_density;
    drag_ = static_cast<Real>(half_density * settings.drag_coefficient);
    lift_ = static_cast<Real>(half_density * settings.lift_coefficient);
    const std::vector<double> area = lumped_masses(input.rest, 1);
    for (int t = 0; t < input.rest.triangle_count(); ++t) {
      Triangle triangle{};
      for (int c = 0; c < 3; ++c) {
        const int vertex = input.rest.triangles()(t, c);
        const auto i = static_cast<std::size_t>(c);
        triangle.corners[i] = static_cast<std::uint32_t>(input.permuted(vertex));
        const double third = input.rest.areas()[static_cast<std::size_t>(t)] / 3;
        triangle.share[i] =
            third > 0 ? static_cast<Real>(third / area[static_cast<std::size_t>(vertex)]) : Real(0);
      }
      triangles_.push_back(triangle);
    }
  }

  // All triangles use the velocities before the pass. The order of triangles, which is fixed, affects
  // rounding.
  void operator()(PassContext<Real>& context) {
    State<Real>& state = context.state;
    std::fill(impulse_.begin(), impulse_.end(), Vector::Zero());
    Vector air = air_.velocity_at(context.time).template cast<Real>();
    for (const Triangle& triangle : triangles_) {
      if (air_.travel) air = local_air(state, triangle, context.time);
      const Vector impulse = impulse_on(triangle, state, air, context.substep);
      if (impulse.isZero(0)) continue;
      for (const std::uint32_t corner : triangle.corners) impulse_[corner] += impulse / Real(3);
      ++context.acted;
    }
    for (std::size_t v = 0; v < impulse_.size(); ++v)
      if (state.position[v].w > 0) state.accelerate(v, state.position[v].w * impulse_[v]);
  }

 private:
  static Vector centroid(const Points<Real>& points, const Triangle& triangle) {
    const auto& c = triangle.corners;
    return (points[c[0]].vector() + points[c[1]].vector() + points[c[2]].vector()) / Real(3);
  }

  Vector local_air(const State<Real>& state, const Triangle& triangle, double time) const {
    const Vector3 centre = centroid(state.position, triangle).template cast<double>() + state.origin;
    return air_.velocity_at(time, centre).template cast<Real>();
  }

  Vector impulse_on(const Triangle& triangle, const State<Real>& state, const Vector& air, Real h) const {
    const auto& [a, b, c] = triangle.corners;
    const Vector origin = state.position[a].vector();
    const Vector doubled =
        (state.position[b].vector() - origin).cross(state.position[c].vector() - origin);  // 2 A n
    const Vector u = centroid(state.velocity, triangle) - air;
    const Real flow = doubled.dot(u), speed_squared = u.squaredNorm(), size = doubled.norm();
    if (!(speed_squared > 0 && size > 0)) return Vector::Zero();
    const Real speed = std::sqrt(speed_squared);
    const Vector drag = -drag_ / 2 * std::abs(flow) * u;
    const Vector lift = -lift_ / 2 * flow * speed / size * (doubled - flow / speed_squared * u);
    Real mass = static_cast<Real>(state.mass[a]) * triangle.share[0];
    mass = std::min(mass, static_cast<Real>(state.mass[b]) * triangle.share[1]);
    mass = 3 * std::min(mass, static_cast<Real>(state.mass[c]) * triangle.share[2]);
    const Real squared = h * (drag.squaredNorm() + lift.squaredNorm()), most = mass * speed * drag.norm();
    return (squared > most ? h * most / squared : h) * (drag + lift);
  }
};

template <class Real>
std::vector<Pass<Real>> compile(const Wind& settings, const EffectInput& input) {
  if (settings.air_density == 0) return {};
  return {{"wind", Stage::force, Blowing<Real>(settings, input)}};
}

bool idle(const Wind& settings) {
  return settings.air_density == 0;
}

// Air at rest can only remove energy from the cloth.
bool drives(const Wind& settings) {
  return !settings.velocity.isZero(0) || settings.gust_amplitude != 0;
}

// Bound on drag and lift on the whole cloth.
double largest_force(const Wind& settings, double area) {
  constexpr double highest_gust = 3.5;  // 2.01 times the amplitude in each of three components
  const double speed = settings.velocity.norm() * (1 + highest_gust * settings.gust_amplitude);
  return 0.5 * settings.air_density * speed * speed * area *
         (settings.drag_coefficient + settings.lift_coefficient);
}

// In a substep the wind removes at most the whole speed of the cloth relative to the air, so that cloth never
// flies up against the wind. Cloth that moves at the speed u relative to the air is slowed within the time τ
// = ρ / (½ ρ_air C_D u). If the substep h is longer than τ, the force is reduced. For example, a sheet at its
// terminal speed (τ = u/g) falls too fast by 23 % at h = 1.2 τ.
std::optional<Doubt> doubt(const Wind& settings, const DoubtInput& input) {
  const double drag = 0.5 * settings.air_density * settings.drag_coefficient,
               terminal = std::sqrt(input.density * input.gravity / drag);
  if (!(drag > 0)) return std::nullopt;
  const double slowed_within = input.density / (drag * std::max(settings.velocity.norm(), terminal));  // s
  if (!(input.substep > slowed_within)) return std::nullopt;
  constexpr double wanted = 0.5;  // substeps
  const double times = input.substep / slowed_within;
  return Doubt{
      fmt::format(
          "a substep of {:.2g} s is too long for the wind, which accelerates this cloth to the wind's speed "
          "within {:.2g} s. So the force of the wind is reduced. Set /solver/substeps to about {}",
          input.substep, slowed_within, static_cast<long>(std::ceil(input.substeps * times / wanted))),
      times, fmt::format("{:.2g} times", times)};
}

}  // namespace wind_effect

constinit const EffectKind Wind::kind{
    .name = "wind",
    .summary = "aerodynamic drag and lift on every triangle, of a steady or gusting wind or of air at rest",
    .source =
        "Wilson et al. 2014 (drag, direction of lift) and Keckeisen et al. 2004 (size of the lift, zero for "
        "cloth along the flow)",
    .settings = table_of<Wind>(wind_effect::fields),
    .acts_first = true,
    .force_follows_pose = true,
    .compile_float = erased<wind_effect::compile<float>>,
    .compile_double = erased<wind_effect::compile<double>>,
    .idle = erased<wind_effect::idle>,
    .drives = erased<wind_effect::drives>,
    .largest_force = erased<wind_effect::largest_force>,
    .doubt = erased<wind_effect::doubt>,
};
}  // namespace bendlab
