// Checks a run, while it is computed, against bounds that no correct result of the scene can exceed, whatever
// the settings of the solver are. The verdict `complete` says that a run reached its end. These checks say
// whether the result of the run is plausible.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "bendlab/metrics/stretch.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "experiments/run/broken_bound.hpp"

namespace bendlab {

class Plausibility {
 public:
  /// Computes the limits from the scene, which must outlive this object.
  explicit Plausibility(const BuiltScene& scene);

  /// To be called after every step. Checks positions and velocities, but not in every call, so that copying
  /// them costs less than 1 % of the time. If `always` is true (for recorded frames), this call checks.
  void look(const Simulation& simulation, bool always);

  /// Checks positions (#V by 3, m) and velocities (#V by 3, m/s) at `time` (s).
  void look(double time, const Positions& positions, const Positions& velocities);

  /// Checks the strain and the stretches (#T) of a recorded frame. May run on another thread than look().
  void look_at_stretch(double time, double mean_strain, std::span<const PrincipalStretches> stretches,
                       const Positions& positions);

  /// Writes or reads the state of the checks. Not to be called during a check.
  void archive(Archive& state);

  /// The bound that was broken first, with advice. Not to be called during a check.
  std::optional<BrokenBound> broken() const;

 private:
  // A value may exceed its lasting limit only for a moment. `since`: when the value rose above the limit.
  struct Lasting {
    std::optional<double> since;  // s
    bool too_long(double time, bool above);
  };
  struct PinPair {
    int a, b;
    double distance;  // m, along the cloth
  };

  void find_stretch_limits();
  void find_reach();
  void find_pin_pairs();
  void find_what_drives();
  void find_start();
  double needed_stretch(const Positions& positions) const;
  std::optional<BrokenBound> look_at_numbers(const Positions& positions, const Positions& velocities) const;
  std::optional<BrokenBound> look_at_reach(const Positions& positions) const;
  std::optional<BrokenBound> look_at_speed(const Positions& positions, const Positions& velocities) const;
  std::optional<BrokenBound> look_at_energy(const Positions& positions, const Positions& velocities) const;
  std::optional<BrokenBound> look_at_momentum(double time, const Positions& positions,
                                              const Positions& velocities) const;
  void keep(std::optional<BrokenBound>& kept, BrokenBound bound, double time,
            const Positions& positions) const;

  const BuiltScene& scene_;
  Vector3 gravity_ = Vector3::Zero();  // m/s²
  double mass_ = 0;                    // kg
  bool driven_ = false;                // wind, moving pins or obstacles do work on the cloth
  bool free_ = false;                  // nothing but gravity changes its momentum
  bool energy_known_ = false;          // whether the energy at the start is known

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  double stretch_ = infinity, lasting_stretch_ = infinity;          // limits
  double mean_strain_ = infinity, lasting_mean_strain_ = infinity;  // limits
  std::vector<PinPair> pin_pairs_;                                  // empty if pins do not move
  std::vector<int> pin_;                                            // #V, the nearest pin; -1: no pin
  std::vector<double> reach_;                                       // #V, m, largest distance from that pin
  double fall_ = 0;             // m, how deep a vertex can fall before its pin holds it
  double speed_at_start_ = 0;   // m/s, of the fastest vertex
  double snap_ = 0;             // m/s, speed at which a slightly strained start pose may spring back
  double energy_at_start_ = 0;  // J, kinetic and, where it is known, elastic
  double energy_scale_ = 0;     // J
  Vector3 velocity_at_start_, centre_at_start_;

  std::uint64_t projections_looked_at_ = 0;
  std::optional<BrokenBound> broken_, broken_stretch_;
  Lasting stretch_lasts_, mean_strain_lasts_;
};

}  // namespace bendlab
