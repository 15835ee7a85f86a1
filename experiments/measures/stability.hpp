// How stable a run was: how far the cloth went, whether it kept momentum and energy, and whether it came back
// to its rest shape. Checked after every step.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "bendlab/metrics/alignment.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/scene/energy.hpp"

namespace bendlab {

class StabilityMeter {
 public:
  /// `duration`: of the run, s. `scene` must outlive the meter.
  StabilityMeter(const BuiltScene& scene, double duration);

  /// To be called at time 0 and after every step, but not after a step that diverged.
  void look(const Simulation& simulation);

  bool lacks_energy() const { return has_history(scene_.input); }
  /// The metrics by name, with the prefix `stability_`.
  std::map<std::string, double> summary();

  void archive(Archive& state) {
    state(now_, half_way_, time_, next_alignment_, reach_, first_reach_, last_reach_, farthest_, distance_,
          least_distance_, recovered_at_, first_velocity_, first_spin_, first_spin_scale_, spin_,
          momentum_drift_, first_energy_, energy_, highest_energy_, energy_scale_, looks_, rises_,
          directors_);
  }

 private:
  void look_at_shape();
  void look_at_energy(const Positions& positions, const Positions& velocities);
  double shut_hinges() const;

  const BuiltScene& scene_;
  Alignment alignment_;
  bool free_;  // nothing acts but gravity
  Vector3 gravity_ = Vector3::Zero();
  Positions now_, half_way_;
  Positions directors_;  // of the last pose, with the least energy
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
