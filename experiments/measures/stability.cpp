#include "experiments/measures/stability.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "bendlab/metrics/motion.hpp"
#include "bendlab/scene/energy.hpp"
#include "bendlab/scene/gravity.hpp"
#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

constexpr double recovered = 0.01;        // of the size
constexpr double energy_rounding = 1e-6;  // of the energy scale: float rounding of the difference of two sums
constexpr double spin_rounding = 1e-6;    // of mass × size × speed: float rounding of a sum that is zero
constexpr double shut = 170;              // degrees
constexpr double alignments_per_second = 10;  // an alignment costs as much as a step of a small sheet

bool nothing_acts_but_gravity(const BuiltScene& scene) {
  return scene.pins.all.empty() && scene.pins.held.empty() &&
         std::ranges::all_of(scene.effects,
                             [](const Effect& effect) { return effect.kind().keeps_angular_momentum; });
}

double farthest_from(const Eigen::RowVector3d& centre, const Positions& positions) {
  return std::sqrt((positions.rowwise() - centre).rowwise().squaredNorm().maxCoeff());
}

// Fold angle in degrees; 0 if the two triangles lie flat, NaN if a triangle has no normal.
double fold(const Hinge& hinge, const Positions& positions) {
  const auto at = [&](int v) -> Vector3 { return positions.row(v).transpose(); };
  const Vector3 a = at(hinge.edge[0]), b = at(hinge.edge[1]);
  const Vector3 n0 = (b - a).cross(at(hinge.opposite[0]) - a), n1 = (at(hinge.opposite[1]) - a).cross(b - a);
  return std::atan2(n0.cross(n1).norm(), n0.dot(n1)) * 180 / std::numbers::pi;
}

}  // namespace

StabilityMeter::StabilityMeter(const BuiltScene& scene, double duration)
    : scene_(scene),
      alignment_(scene.rest),
      free_(nothing_acts_but_gravity(scene)),
      gravity_(gravity_of(scene.effects)),
      half_time_(0.5 * duration),
      mass_(std::accumulate(scene.input.mass.begin(), scene.input.mass.end(), 0.0)),
      size_(scene.rest.size()) {}

void StabilityMeter::look_at_energy(const Positions& positions, const Positions& velocities) {
  const double before = energy_;
  energy_ = motion_of(scene_.input.mass, positions, velocities).kinetic_energy +
            potential_energy(scene_, positions, &directors_);
  if (looks_ == 0) {
    first_energy_ = highest_energy_ = energy_;
    energy_scale_ = energy_ + mass_ * gravity_.norm() * size_;  // the same as energy_scale()
  } else if (energy_ > before + energy_rounding * energy_scale_) {
    ++rises_;
  }
  highest_energy_ = std::max(highest_energy_, energy_);
}

void StabilityMeter::look_at_shape() {
  next_alignment_ = time_ + 1 / alignments_per_second - 1e-9;
  distance_ = alignment_.distance(now_) / size_;
  least_distance_ = looks_ == 0 ? distance_ : std::min(least_distance_, distance_);
  if (!(distance_ < recovered))
    recovered_at_.reset();
  else if (!recovered_at_)
    recovered_at_ = time_;
}

void StabilityMeter::look(const Simulation& simulation) {
  now_ = simulation.positions();
  const Positions velocities = simulation.velocities();
  time_ = simulation.time();
  last_reach_ = farthest_from(now_.colwise().mean(), now_) / size_;
  if (looks_ == 0) first_reach_ = last_reach_;
  reach_ = std::max(reach_, last_reach_);
  farthest_ = std::max(farthest_, farthest_from(scene_.input.origin.transpose(), now_));
  if (time_ >= next_alignment_) look_at_shape();
  if (time_ <= half_time_) half_way_ = now_;
  if (free_) {
    const Motion motion = motion_of(scene_.input.mass, now_, velocities);
    const Vector3 velocity = motion.linear_momentum / mass_ - time_ * gravity_;
    spin_ = motion.angular_momentum.norm();
    if (looks_ == 0) {
      first_velocity_ = velocity, first_spin_ = spin_;
      first_spin_scale_ = mass_ * size_ * std::sqrt(velocities.rowwise().squaredNorm().maxCoeff());
    }
    momentum_drift_ = std::max(momentum_drift_, (velocity - first_velocity_).norm());
  }
  look_at_energy(now_, velocities);
  ++looks_;
}

double StabilityMeter::shut_hinges() const {
  const std::vector<Hinge>& hinges = scene_.rest.hinges();
  const auto count = std::ranges::count_if(hinges, [&](const Hinge& hinge) {
    return fold(hinge, now_) > shut && !(fold(hinge, scene_.rest.positions()) > shut);
  });
  return hinges.empty() ? 0 : static_cast<double>(count) / static_cast<double>(hinges.size());
}

std::map<std::string, double> StabilityMeter::summary() {
  look_at_shape();
  std::map<std::string, double> summary = {
      {"steps", static_cast<double>(looks_ - 1)},
      {"reach", reach_},
      {"reach_start", first_reach_},
      {"reach_end", last_reach_},
      {"rest_distance", distance_},
      {"least_rest_distance", least_distance_},
      {"creep", std::sqrt((now_ - half_way_).rowwise().squaredNorm().mean()) / size_},
      {"shut_hinges", shut_hinges()},
  };
  if (recovered_at_) summary["recovered_at"] = *recovered_at_;
  if (free_) {
    const bool in_double = scene_.precision == Precision::double_precision;
    const double epsilon =
        in_double ? std::numeric_limits<double>::epsilon() : double{std::numeric_limits<float>::epsilon()};
    const SolverSettings& solver = scene_.input.settings;
    summary["momentum_drift"] = momentum_drift_;
    summary["rounding_speed"] = epsilon * farthest_ * solver.substeps / solver.dt;
    if (first_spin_ > spin_rounding * first_spin_scale_) summary["spin_kept"] = spin_ / first_spin_;
  }
  if (energy_scale_ > 0) {
    summary["energy_scale"] = energy_scale_;
    summary["energy_gain"] = (highest_energy_ - first_energy_) / energy_scale_;
    summary["energy_rises"] = static_cast<double>(rises_) / static_cast<double>(std::max(looks_ - 1, 1L));
  }
  std::map<std::string, double> named;
  for (const auto& [name, value] : summary) named["stability_" + name] = value;
  return named;
}

namespace {

class Stability final : public Measurement {
 public:
  Stability(const RunConfig& config, const BuiltScene& scene) : meter_(scene, config.scene().duration) {}

  void step(const Simulation& simulation, const Moment&) override { meter_.look(simulation); }
  void finish(const RunEnd&, Findings& findings) override {
    findings.summary.merge(meter_.summary());
    if (meter_.lacks_energy())
      findings.messages.push_back(
          "stability_energy_scale, _gain and _rises are not known, because the energy does not follow from "
          "the "
          "pose alone (hysteresis, plasticity, over_time)");
  }
  void archive(Archive& state) override { meter_.archive(state); }

 private:
  StabilityMeter meter_;
};

std::vector<Quantity> stability_quantities() {
  return {
      {"stability_steps", "1", "number of steps"},
      {"stability_reach", "1", "largest distance of a vertex from the mean of all vertices, in mesh sizes"},
      {"stability_reach_start", "1", "stability_reach of the start pose"},
      {"stability_reach_end", "1", "stability_reach of the last pose"},
      {"stability_rest_distance", "1",
       "root mean square distance from the rest shape at the end, after rigid alignment, in mesh sizes"},
      {"stability_least_rest_distance", "1",
       "smallest value of stability_rest_distance in the run, checked ten times a second"},
      {"stability_recovered_at", "s",
       "time from which on stability_rest_distance stays below 0.01, exact to 0.1 s; absent if the distance "
       "is larger at the end"},
      {"stability_creep", "1",
       "root mean square displacement of the vertices in the second half of the run, in mesh sizes"},
      {"stability_momentum_drift", "m/s",
       "largest difference between the velocity of the centre of mass and v0 + g t; only for a cloth without "
       "pins that lists no effects except gravity, rigid_damping and constraint_damping"},
      {"stability_rounding_speed", "m/s",
       "for comparison with stability_momentum_drift: the speed ε d / h that rounding a coordinate causes in "
       "a substep h, where d is the largest distance of a vertex from the centre of the rest box"},
      {"stability_spin_kept", "1",
       "angular momentum at the end divided by its value at the start; only for a spinning cloth without "
       "pins that lists no effects except gravity, rigid_damping and constraint_damping"},
      {"stability_energy_scale", "J",
       "total energy at the start plus the cloth's weight times its size. The total energy includes the "
       "elastic energy of constraints with a compliance; constraints with k have no elastic energy"},
      {"stability_energy_gain", "1",
       "largest rise of the total energy above its value at the start, as a share of energy_scale"},
      {"stability_energy_rises", "1",
       "share of the steps in which the total energy rose by more than 10⁻⁶ of energy_scale"},
      {"stability_shut_hinges", "1",
       "share of the hinges that are folded by more than 170 degrees at the end, but not at rest"},
  };
}

}  // namespace

namespace measure {
extern const Measure stability{
    .name = "stability",
    .summary =
        "how far the cloth went, whether it kept momentum and energy, and whether it came back to its rest "
        "shape",
    .cost = "positions, velocities and energies after every step; ten alignments per simulated second",
    .gives = stability_quantities,
    .begin = begun<Stability>};
}  // namespace measure
}  // namespace bendlab
