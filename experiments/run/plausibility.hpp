// Whether a run is plausible: while it runs, it is checked against bounds that its scene cannot break,
// whatever the settings of the solver are. `complete` says that a run went to its end; this says whether to
// believe it.
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
  /// The limits that follow from the scene, which must outlive this.
  explicit Plausibility(const BuiltScene& scene);

  /// To be called after every step. Checks positions and velocities, but only after so many projections that
  /// copying them costs less than 1 % of the time; with `always` it checks now, as at every recorded frame.
  void look(const Simulation& simulation, bool always);

  /// The same on values (#V by 3, m and m/s) at a time in s.
  void look(double time, const Positions& positions, const Positions& velocities);

  /// Checks what was measured of a frame; may run on another thread than look(). `stretches`: #T.
  void look_at_stretch(double time, double mean_strain, std::span<const PrincipalStretches> stretches,
                       const Positions& positions);

  /// Writes or reads what was seen so far; while no look is under way.
  void archive(Archive& state);

  /// The bound that was broken first, with advice. Not to be called while a check may be under way.
  std::optional<BrokenBound> broken() const;

 private:
  // A value may pass its lasting limit for a moment only: since when it has been above it.
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
  void keep(std::optional<BrokenBound>& kept, BrokenBound found, double time,
            const Positions& positions) const;

  const BuiltScene& scene_;
  Vector3 gravity_ = Vector3::Zero();  // m/s²
  double mass_ = 0;                    // kg
  bool driven_ = false;                // wind, moving pins or obstacles do work on the cloth
  bool free_ = false;                  // nothing but gravity changes its momentum
  bool energy_known_ = false;          // of the start

  static constexpr double none = std::numeric_limits<double>::infinity();
  double stretch_ = none, lasting_stretch_ = none;          // limits
  double mean_strain_ = none, lasting_mean_strain_ = none;  // limits
  std::vector<PinPair> pin_pairs_;                          // of moving pins
  std::vector<int> pin_;                                    // #V, the nearest; -1: none
  std::vector<double> reach_;                               // #V, m
  double fall_ = 0;             // m, how deep a vertex can fall before its pin holds it
  double speed_at_start_ = 0;   // m/s, the fastest
  double snap_ = 0;             // m/s, at which a slightly strained start pose may spring back
  double energy_at_start_ = 0;  // J, kinetic and, where it is known, elastic
  double energy_scale_ = 0;     // J
  Vector3 velocity_at_start_, centre_at_start_;

  std::uint64_t projections_looked_at_ = 0;
  std::optional<BrokenBound> broken_, broken_stretch_;
  Lasting stretch_lasts_, mean_strain_lasts_;
};

}  // namespace bendlab
