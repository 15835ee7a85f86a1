// Simulates a scene with a few lines of C++.
#pragma once

#include <memory>
#include <vector>

#include "bendlab/scene/built_scene.hpp"

namespace bendlab {

/// A cloth in motion: a built scene and a simulation. An object can be moved, but not copied.
class Cloth {
 public:
  explicit Cloth(BuiltScene scene);

  /// One time step Solver::dt. Throws std::runtime_error with the time and a vertex if the cloth diverged.
  void step();
  /// Makes steps until `seconds` have passed, or until further steps would not change anything.
  void run(double seconds);

  double time() const { return simulation_->time(); }                      ///< s
  Positions positions() const { return simulation_->positions(); }         ///< #V by 3, m
  Positions velocities() const { return simulation_->velocities(); }       ///< #V by 3, m/s
  const Triangles& triangles() const { return scene_->rest.triangles(); }  ///< #T by 3
  const BuiltScene& scene() const { return *scene_; }
  Simulation& simulation() { return *simulation_; }

 private:
  std::unique_ptr<BuiltScene> scene_;  // on the heap, because the simulation may keep a reference
  std::unique_ptr<Simulation> simulation_;
};

/// Builds a scene, sets defaults that depend on other settings, and simulates the earlier scene of
/// Initial::after. Throws ConfigError with all problems (values out of range, unread settings, settings that
/// contradict each other), and what build_scene() throws.
Cloth simulate(Scene scene);

}  // namespace bendlab
