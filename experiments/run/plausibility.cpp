#include "experiments/run/plausibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bendlab/effects/effect.hpp"
#include "bendlab/io/without_traps.hpp"
#include "bendlab/mesh/geodesics.hpp"
#include "bendlab/metrics/motion.hpp"
#include "bendlab/metrics/stretch.hpp"
#include "bendlab/scene/energy.hpp"
#include "bendlab/scene/gravity.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/run/remedies.hpp"

namespace bendlab {
namespace {

// ---- The limits. A limit is a value that the scene cannot exceed, times a margin for the errors of a solver

// A membrane with k, or with compliance 0, should not stretch, but too few iterations leave some stretch. On
// 16 cells the paper's scene has triangles 1.5 times as long as at rest and, at the end of a swing, 2.2 times
// for a moment. Figure 1 of the paper calls a pin wrong if the stretch at the pin is above 2.
constexpr double largest_stretch = 3, largest_lasting_stretch = 2;
// The mean strain over all triangles is 0.04 in the paper's scene, and at most 0.08 for a moment.
constexpr double largest_mean_strain = 0.3, largest_lasting_mean_strain = 0.2;
constexpr double moment = 0.5;  // s; the end of a swing exceeds a lasting limit for less time than this

// Factor on the strain of a membrane with a compliance. A sudden load stretches the membrane twice as far as
// a resting load. The triangles at a corner share a load unevenly: one of them carries twice its share.
constexpr double sudden_and_uneven = 4;

// Largest stretch of a whole path from a pin. A single triangle of the path may be stretched farther.
constexpr double largest_way_stretch = 1.5;

// The whipping tip of a cloth is faster than falling cloth, because the tip takes energy from its neighbours.
// A factor of 4 in speed is a factor of 16 in energy.
constexpr double whip = 4;

// Shares of the energy scale. With PBD the energy may rise: iterations that project the constraints in one
// order only, with small steps, leave speeds up to 1 m/s. For a sheet of 1 m, this is an energy of 0.04 of
// weight times size. An implicit step that finds its minimum gains no energy.
constexpr double largest_energy_gain = 0.25, largest_implicit_gain = 0.02;

// Allowed error of the velocity, as a share of the sum of g t, v0 and the speed of the fastest vertex. With
// gravity, rounding errors must stay within this share, because they must not cancel gravity.
constexpr double momentum_share = 0.01;
// Without gravity, a further error is allowed: `walks` times the speed to which rounding errors add up in a
// random walk. The stability page uses the same factor.
constexpr double walks = 8;

// A check copies positions and velocities. For 65² vertices the copies take 32 to 51 µs, about 10 ns per
// vertex; 1000 projections take at least 2 µs. On this mesh, checks take 0.3 % of a step without bending and
// with 1 iteration, 0.2 % with 10 iterations, and 0.5 % with the model adaptive and 1 or 10 iterations.
constexpr double projections_per_vertex_and_look = 1000;

constexpr double roundings = 100;  // jitter of a projected sheet at rest, over rounding of its size
constexpr double strained = 0.01;  // a start pose with more strain has elastic energy, unknown with k
constexpr double unstrained_bending = 1e-3;  // of an edge; smaller corrections come from a perturbation

Vector3 row(const Positions& rows, Eigen::Index index) {
  return rows.row(index).transpose();
}

const Positions& or_zero(const Positions& velocities, const Positions& zero) {
  return velocities.rows() > 0 ? velocities : zero;
}

double epsilon_of(const BuiltScene& scene) {
  return scene.precision == Precision::double_precision ? std::numeric_limits<double>::epsilon()
                                                        : double{std::numeric_limits<float>::epsilon()};
}

// The largest force on the whole cloth, N: the sum over the effects that state a largest force.
double largest_force(const BuiltScene& scene) {
  const double area = std::accumulate(scene.rest.areas().begin(), scene.rest.areas().end(), 0.0);
  double force = 0;
  for (const Effect& effect : scene.effects)
    if (effect.kind().largest_force != nullptr) force += effect.kind().largest_force(effect.settings(), area);
  return force;
}

// The share of a strain constraint's error that a step removes.
double share_per_step(const StrainStiffness& strain, double k, const SimulationInput& input) {
  const int rounds = strain.kind == StiffnessKind::k
                         ? input.settings.substeps * projections_per_substep(input)
                         : input.settings.substeps;
  return 1 - std::pow(1 - k, rounds);
}

}  // namespace

Plausibility::Plausibility(const BuiltScene& scene)
    : scene_(scene),
      gravity_(gravity_of(scene.effects)),
      mass_(std::accumulate(scene.input.mass.begin(), scene.input.mass.end(), 0.0)) {
  const WithoutTraps traps_are_off;
  find_what_drives();
  find_start();
  find_stretch_limits();
  find_reach();
  if (std::ranges::any_of(scene.effects, [](const Effect& effect) { return effect.kind().moves_pins; }))
    find_pin_pairs();
}

void Plausibility::find_what_drives() {
  const SimulationInput& input = scene_.input;
  driven_ = std::ranges::any_of(scene_.effects, does_work) || input.strain_schedule.rises() ||
            input.bending_schedule.rises();
  free_ =
      scene_.pins.all.empty() && scene_.pins.held.empty() && scene_.input.method.kind().keeps_momentum &&
      std::ranges::all_of(scene_.effects, [](const Effect& effect) { return effect.kind().keeps_momentum; });
}

// The energy at the start is kinetic energy plus the elastic energy of constraints with a compliance.
// Constraints with k have no defined energy, so with k the energy of a strained start pose is unknown.
void Plausibility::find_start() {
  const SimulationInput& input = scene_.input;
  const Positions zero = Positions::Zero(input.positions.rows(), 3);
  const Positions& velocities = or_zero(input.velocities, zero);
  const Motion motion = motion_of(input.mass, input.positions, velocities);
  const double elastic = elastic_energy(input, input.positions);
  speed_at_start_ = std::sqrt(velocities.rowwise().squaredNorm().maxCoeff());
  velocity_at_start_ = motion.linear_momentum / mass_;
  centre_at_start_ = Vector3::Zero();
  for (std::size_t v = 0; v < input.mass.size(); ++v)
    centre_at_start_ += input.mass[v] / mass_ * row(input.positions, static_cast<Eigen::Index>(v));
  energy_at_start_ = motion.kinetic_energy + elastic;

  StretchMeter meter(scene_.rest, scene_.pins);
  double largest = 0;
  for (const PrincipalStretches& s : meter.measure(input.positions))
    largest = std::max({largest, s.largest - 1, 1 - s.smallest});
  // Constraints with k may undo the strain of a pose within a substep, even a strain that comes from
  // rounding.
  const double size = scene_.rest.size(),
               back = size * (std::min(largest, strained) + roundings * epsilon_of(scene_));
  snap_ = back * input.settings.substeps / input.settings.dt;
  energy_scale_ = energy_at_start_ + mass_ * (gravity_.norm() * size + 0.5 * snap_ * snap_);
  const bool membrane_has_energy =
      input.strain_stiffness.kind == StiffnessKind::compliance && input.strain_stiffness.compliance > 0;
  const bool bending_has_energy =
      input.bending_stiffness.kind == StiffnessKind::compliance && input.bending_stiffness.compliance > 0;
  const double largest_correction =
      bending_has_energy ? 0 : largest_bending_correction(input, input.positions);
  // elastic_energy() leaves out the energy of a membrane of springs along edges (kang_cho).
  energy_known_ = (largest <= strained || (membrane_has_energy && input.edges.size() == 0)) &&
                  largest_correction <= unstrained_bending * scene_.rest.mean_edge_length();
}

// A membrane's compliance α is 1 over its stiffness in N/m. A load W on a width w strains the membrane by α W
// / w. An impact at the speed v strains the membrane by v √(α ρ), which is v over the membrane's wave speed.
// The scene's energy E strains the area A of the membrane by √(2 α E / A) on average.
void Plausibility::find_stretch_limits() {
  const SimulationInput& input = scene_.input;
  const StrainStiffness& strain = input.strain_stiffness;
  const double area = std::accumulate(scene_.rest.areas().begin(), scene_.rest.areas().end(), 0.0);
  double softer = 0, softer_mean = 0, share = 1, shear_share = 1;
  if (strain.kind == StiffnessKind::compliance || input.edges.size() > 0) {
    const double load = mass_ * gravity_.norm() + largest_force(scene_);
    const double energy = energy_scale_ + largest_force(scene_) * scene_.rest.size();
    const double speed = std::sqrt(2 * energy / mass_);
    const double softest = input.softest_membrane() / input.strain_schedule.least();
    softer = sudden_and_uneven *
             (softest * load / scene_.rest.mean_edge_length() + speed * std::sqrt(softest * mass_ / area));
    softer_mean = std::sqrt(2 * softest * energy / area);
  } else {
    share = share_per_step(strain, std::min(strain.warp, strain.weft), input);
    shear_share = share_per_step(strain, strain.shear, input);
  }
  if (!(share > 0)) return;  // warp or weft is free to stretch
  // If warp and weft keep their lengths, a triangle that is sheared flat is √2 times as long and has no
  // width.
  const double sheared = shear_share < 0.5 ? std::sqrt(2.0) : 1;
  const auto above_one = [&](double limit) { return sheared * (1 + (limit - 1) / share + softer); };
  stretch_ = above_one(largest_stretch), lasting_stretch_ = above_one(largest_lasting_stretch);
  if (shear_share >= 0.5) {
    mean_strain_ = largest_mean_strain / share + softer_mean;
    lasting_mean_strain_ = largest_lasting_mean_strain / share + softer_mean;
  }
  // A run may stay as stretched as its start pose.
  const StretchMeter meter(scene_.rest, scene_.pins);
  const StretchSummary start = meter.summarise(meter.measure(input.positions));
  const auto also_start = [](double& limit, double at_start) {
    constexpr double swing = 1.5;  // cloth that springs back may overshoot
    if (std::isfinite(at_start) && at_start > 1) limit = std::max(limit, swing * at_start);
  };
  also_start(stretch_, start.max_stretch), also_start(lasting_stretch_, start.max_stretch);
  if (start.mean_strain > strained) {
    constexpr double swing = 1.5;
    mean_strain_ = std::max(mean_strain_, swing * start.mean_strain);
    lasting_mean_strain_ = std::max(lasting_mean_strain_, swing * start.mean_strain);
  }
}

// The limit on the distance of each vertex from its nearest pin: the stretched path along the cloth, plus one
// edge at the pin that is stretched as far as a single triangle may be.
void Plausibility::find_reach() {
  if (scene_.pins.all.empty() || !std::isfinite(stretch_)) return;
  const Positions& start = scene_.input.positions;
  const GeodesicDistances way = geodesic_distances(scene_.rest, scene_.pins.all);
  const double stretched = std::max(largest_way_stretch, lasting_stretch_ / largest_lasting_stretch),
               at_pin = stretch_ * scene_.rest.mean_edge_length();
  pin_ = way.source;
  reach_.assign(pin_.size(), infinity);
  for (std::size_t v = 0; v < pin_.size(); ++v) {
    if (pin_[v] < 0) continue;
    const auto vertex = static_cast<Eigen::Index>(v);
    const double at_start = (row(start, vertex) - row(start, pin_[v])).norm();
    reach_[v] = std::max(stretched * way.distance[v], at_start) + at_pin;
    const double height = -row(start, vertex).dot(scene_.down), pin = -row(start, pin_[v]).dot(scene_.down);
    fall_ = std::max(fall_, height - (pin - way.distance[v]));
  }
}

// Distances along the cloth between sampled pins. The sampled pins lie as far apart as possible.
void Plausibility::find_pin_pairs() {
  constexpr std::size_t most = 12;
  const std::vector<int>& pins = scene_.pins.all;
  if (pins.size() < 2) return;
  std::vector<double> nearest(pins.size(), infinity);
  std::size_t next = 0;
  std::vector<int> sample;
  while (sample.size() < std::min(most, pins.size())) {
    const int from = pins[next];
    const GeodesicDistances way = geodesic_distances(scene_.rest, std::array{from});
    for (const int other : sample)
      if (const double distance = way.distance[static_cast<std::size_t>(other)];
          distance > 0 && std::isfinite(distance))
        pin_pairs_.push_back({from, other, distance});
    sample.push_back(from);
    for (std::size_t p = 0; p < pins.size(); ++p)
      nearest[p] = std::min(nearest[p], way.distance[static_cast<std::size_t>(pins[p])]);
    next = static_cast<std::size_t>(std::ranges::max_element(nearest) - nearest.begin());
    if (!(nearest[next] > 0)) break;
  }
}

// The stretch (length over rest length, at least 1) that the moved pins force on the cloth between them.
double Plausibility::needed_stretch(const Positions& positions) const {
  double needed = 1;
  for (const PinPair& pair : pin_pairs_)
    needed = std::max(needed, (row(positions, pair.a) - row(positions, pair.b)).norm() / pair.distance);
  return needed;
}

void Plausibility::keep(std::optional<BrokenBound>& kept, BrokenBound bound, double time,
                        const Positions& positions) const {
  bound.time = time;
  if (bound.bound != Bound::finite)
    bound.correction = worst_correction(scene_.input, positions, bound.vertex);
  kept = std::move(bound);
}

void Plausibility::look(const Simulation& simulation, bool always) {
  if (broken_) return;
  const std::uint64_t projections = simulation.projections();
  const double due = projections_per_vertex_and_look * scene_.rest.vertex_count();
  if (!always && static_cast<double>(projections - projections_looked_at_) < due) return;
  projections_looked_at_ = projections;
  look(simulation.time(), simulation.positions(), simulation.velocities());
}

void Plausibility::look(double time, const Positions& positions, const Positions& velocities) {
  if (broken_) return;
  const WithoutTraps traps_are_off;
  std::optional<BrokenBound> bound = look_at_numbers(positions, velocities);
  if (!bound) bound = look_at_reach(positions);
  const bool has_motion = scene_.input.method.kind().has_motion;
  if (!bound && has_motion) bound = look_at_momentum(time, positions, velocities);
  if (!bound && has_motion) bound = look_at_speed(positions, velocities);
  if (!bound && has_motion) bound = look_at_energy(positions, velocities);
  if (bound) keep(broken_, *std::move(bound), time, positions);
}

std::optional<BrokenBound> Plausibility::look_at_numbers(const Positions& positions,
                                                         const Positions& velocities) const {
  const double sum = positions.sum() + velocities.sum();
  if (sum - sum == 0) return std::nullopt;
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
    if (!positions.row(v).allFinite() || !velocities.row(v).allFinite())
      return BrokenBound{.bound = Bound::finite,
                         .measured = std::numeric_limits<double>::quiet_NaN(),
                         .vertex = static_cast<int>(v)};
  return std::nullopt;
}

std::optional<BrokenBound> Plausibility::look_at_reach(const Positions& positions) const {
  if (reach_.empty()) return std::nullopt;
  const double needed = needed_stretch(positions);
  double worst = 1;
  std::optional<BrokenBound> bound;
  for (std::size_t v = 0; v < reach_.size(); ++v) {
    if (pin_[v] < 0) continue;
    const double limit = needed * reach_[v];
    const double square =
        (positions.row(static_cast<Eigen::Index>(v)) - positions.row(pin_[v])).squaredNorm();
    if (!(square > worst * worst * limit * limit)) continue;
    worst = std::sqrt(square) / limit;
    bound = BrokenBound{
        .bound = Bound::reach, .measured = std::sqrt(square), .limit = limit, .vertex = static_cast<int>(v)};
  }
  return bound;
}

std::optional<BrokenBound> Plausibility::look_at_speed(const Positions& positions,
                                                       const Positions& velocities) const {
  if (driven_ || !energy_known_) return std::nullopt;
  Eigen::Index fastest = 0;
  const double square = velocities.rowwise().squaredNorm().maxCoeff(&fastest);
  // Cloth without a pin keeps falling, and a piece of the mesh without a pin, too.
  double fall = scene_.rest.size() + fall_;
  const double highest = -(scene_.input.positions * scene_.down).minCoeff();
  fall += std::max(0.0, highest - -row(positions, fastest).dot(scene_.down));
  const double of_energy = 2 * energy_at_start_ / mass_;
  const double limit = whip * std::sqrt(speed_at_start_ * speed_at_start_ + snap_ * snap_ + of_energy +
                                        2 * gravity_.norm() * fall);
  if (!(square > limit * limit)) return std::nullopt;
  return BrokenBound{.bound = Bound::speed,
                     .measured = std::sqrt(square),
                     .limit = limit,
                     .vertex = static_cast<int>(fastest)};
}

// Elastic energy counts only at the start. Later, the strain that iterations leave in a stiff membrane would
// count as far more energy than the scene has.
std::optional<BrokenBound> Plausibility::look_at_energy(const Positions& positions,
                                                        const Positions& velocities) const {
  if (driven_ || !energy_known_) return std::nullopt;
  const SimulationInput& input = scene_.input;
  double energy = 0;
  for (std::size_t v = 0; v < input.mass.size(); ++v) {
    const auto vertex = static_cast<Eigen::Index>(v);
    energy += input.mass[v] * (0.5 * velocities.row(vertex).squaredNorm() -
                               (positions.row(vertex) - input.positions.row(vertex)).dot(gravity_));
  }
  const double share = input.method.kind().projects ? largest_energy_gain : largest_implicit_gain;
  const double gain = energy - energy_at_start_, limit = share * energy_scale_;
  if (!(gain > limit)) return std::nullopt;
  Eigen::Index fastest = 0;
  velocities.rowwise().squaredNorm().maxCoeff(&fastest);
  return BrokenBound{
      .bound = Bound::energy, .measured = gain, .limit = limit, .vertex = static_cast<int>(fastest)};
}

// Rounding a coordinate at the distance d from the origin changes a speed by ε d / h. A projection rounds at
// most four points. These errors have random signs, so N errors add up to √N times one error. The mean
// velocity is their sum over the number of vertices.
std::optional<BrokenBound> Plausibility::look_at_momentum(double time, const Positions& positions,
                                                          const Positions& velocities) const {
  if (!free_ || !(time > 0)) return std::nullopt;
  const SimulationInput& input = scene_.input;
  Vector3 velocity = Vector3::Zero(), centre = Vector3::Zero();
  for (std::size_t v = 0; v < input.mass.size(); ++v) {
    velocity += input.mass[v] / mass_ * row(velocities, static_cast<Eigen::Index>(v));
    centre += input.mass[v] / mass_ * row(positions, static_cast<Eigen::Index>(v));
  }
  const double farthest =
      std::sqrt((positions.rowwise() - input.origin.transpose()).rowwise().squaredNorm().maxCoeff());
  const SolverSettings& solver = input.settings;
  const double substeps = time / solver.dt * solver.substeps, vertices = scene_.rest.vertex_count();
  const double constraints = static_cast<double>(input.strain.size() + input.distance.size() +
                                                 element_count(input.elements) + input.own.size());
  const double walk =
      std::sqrt(4 * constraints * substeps * projections_per_substep(scene_.input)) / vertices;
  const double rounding = epsilon_of(scene_) * farthest * solver.substeps / solver.dt * std::max(walk, 1.0);
  const double fallen = gravity_.norm() * time;
  const double fastest = std::sqrt(velocities.rowwise().squaredNorm().maxCoeff());
  const double moving = fallen + velocity_at_start_.norm();
  const double allowed = fallen > 0 ? 0 : walks * rounding;
  const double speed_limit = momentum_share * (moving + std::max(fastest, speed_at_start_)) + allowed;
  const double off = (velocity - velocity_at_start_ - time * gravity_).norm();
  if (off > speed_limit)
    return BrokenBound{.bound = Bound::momentum, .measured = off, .limit = speed_limit, .vertex = -1};
  // A step increases v before it moves x, so x moves farther than g t²/2, by g t h / 2; h is at most dt.
  const double way_limit = speed_limit * time + 0.5 * fallen * solver.dt;
  const double way_off =
      (centre - centre_at_start_ - time * velocity_at_start_ - 0.5 * time * time * gravity_).norm();
  if (way_off > way_limit)
    return BrokenBound{.bound = Bound::fall, .measured = way_off, .limit = way_limit, .vertex = -1};
  return std::nullopt;
}

bool Plausibility::Lasting::too_long(double time, bool above) {
  if (!above) {
    since.reset();
    return false;
  }
  if (!since) since = time;
  return time - *since >= moment;
}

void Plausibility::look_at_stretch(double time, double mean_strain,
                                   std::span<const PrincipalStretches> stretches,
                                   const Positions& positions) {
  if (broken_stretch_ || stretches.empty()) return;
  const WithoutTraps traps_are_off;
  const auto recorded = [](const PrincipalStretches& s) { return static_cast<float>(s.largest); };
  const auto largest = std::ranges::max_element(stretches, {}, recorded);
  const double needed = needed_stretch(positions), stretch = static_cast<double>(recorded(*largest));
  const auto limit_passed = [&](double value, double limit, double lasting, Lasting& lasts) {
    const bool too_long = lasts.too_long(time, value > lasting);
    return value > limit ? limit : too_long ? lasting : infinity;
  };
  const auto triangle = static_cast<Eigen::Index>(largest - stretches.begin());
  const int vertex = scene_.rest.triangles()(triangle, 0);
  const double limit = limit_passed(stretch, needed * stretch_, needed * lasting_stretch_, stretch_lasts_);
  if (std::isfinite(limit))
    return keep(broken_stretch_,
                {.bound = Bound::stretch, .measured = stretch, .limit = limit, .vertex = vertex}, time,
                positions);
  const double mean_limit = limit_passed(mean_strain, mean_strain_ + needed - 1,
                                         lasting_mean_strain_ + needed - 1, mean_strain_lasts_);
  if (std::isfinite(mean_limit))
    keep(broken_stretch_,
         {.bound = Bound::mean_strain, .measured = mean_strain, .limit = mean_limit, .vertex = vertex}, time,
         positions);
}

void Plausibility::archive(Archive& state) {
  state(projections_looked_at_, stretch_lasts_.since, mean_strain_lasts_.since);
  for (std::optional<BrokenBound>* broken : {&broken_, &broken_stretch_}) {
    std::string text = *broken ? to_json(**broken).dump() : "";
    state(text);
    if (state.reads()) *broken = text.empty() ? std::nullopt : broken_bound_of(Json::parse(text));
  }
}

std::optional<BrokenBound> Plausibility::broken() const {
  std::optional<BrokenBound> first = broken_;
  if (broken_stretch_ && (!first || broken_stretch_->time < first->time)) first = broken_stretch_;
  if (first) first->advice = remedies_for(first->bound, scene_);
  return first;
}

}  // namespace bendlab
