// How stable a run was, looked at after every step: where the cloth went, whether it kept what nothing took from it, and
// whether it came back to its rest shape.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "bendlab/metrics/alignment.hpp"
#include "experiments/scene/scene.hpp"

namespace bendlab {

class StabilityMeter {
 public:
  /// Of a run of `duration` s; `scene` must outlive the meter.
  StabilityMeter(const Scene& scene, double duration);

  /// To be called at time 0 and after every step; a step that diverged is left out.
  void look(const Simulation& simulation);

  /// What was seen, by name, each beginning with `stability_`:
  ///   steps           looks after time 0
  ///   reach           farthest that a vertex was from the mean of all, in sizes of the mesh;
  ///   reach_start, reach_end   the same of the first and the last look
  ///   rest_distance   at the end, root mean square distance from the rest shape after alignment, in sizes;
  ///   least_rest_distance of ten looks a second
  ///   recovered_at    since when it has been below 0.01, to 0.1 s; absent if it is not at the end
  ///   creep           how far the cloth moved in the second half of the run, root mean square, in sizes
  ///   momentum_drift  largest difference of the velocity of the centre of mass from v0 + g t, m/s; of a cloth without pins
  ///                   and with no effect but gravity and damping, which keeps momentum
  ///   rounding_speed  beside it: ε d / h, to which one rounding of a coordinate comes at the largest distance d from the
  ///                   rest box's centre that any vertex had
  ///   spin_kept       angular momentum at the end over that at the start; of such a cloth that spins
  ///   energy_gain     by how much the total energy was above its start at most, as a share of energy_scale (J): kinetic
  ///                   energy at the start, elastic energy, and weight times size. Elastic energy is that of compliances;
  ///                   k has none
  ///   energy_rises    share of the steps in which the total energy rose by more than 10⁻⁶ of that
  ///   shut_hinges     share of the hinges that are folded by more than 170 degrees at the end, and that were not at rest
  std::map<std::string, double> summary();

 private:
  void look_at_shape();
  void look_at_energy(const Positions& positions, const Positions& velocities);
  double shut_hinges() const;

  const Scene& scene_;
  Alignment alignment_;
  bool free_;  // nothing acts but gravity
  Vector3 gravity_ = Vector3::Zero();
  Positions now_, half_way_;
  double half_time_, time_ = 0, next_alignment_ = 0;
  double mass_ = 0, size_, reach_ = 0, first_reach_ = 0, last_reach_ = 0, farthest_ = 0, distance_ = 0,
         least_distance_ = 0;
  std::optional<double> recovered_at_;
  Vector3 first_velocity_ = Vector3::Zero();
  double first_spin_ = 0, first_spin_scale_ = 0, spin_ = 0, momentum_drift_ = 0;
  double first_energy_ = 0, energy_ = 0, highest_energy_ = 0, energy_scale_ = 0;
  long looks_ = 0, rises_ = 0;
};

}  // namespace bendlab
