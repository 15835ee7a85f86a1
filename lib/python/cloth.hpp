// A cloth as Python sees it: arrays that stay where they are, and one caller at a time.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bendlab/bendlab.hpp"
#include "hand.hpp"

namespace bendlab {

class PythonCloth {
 public:
  /// Reads a scene from JSON; `mesh` takes the place of a generator. Throws ConfigError for a wrong scene,
  /// and what simulate() throws.
  PythonCloth(const std::string& scene, const std::string& folder, std::optional<TriangleMesh> mesh);

  /// One time step, without the GIL. Throws std::runtime_error if the cloth diverged, or if another call is
  /// using the cloth. Passes on an exception that a Python model or effect raises; the cloth is then as it
  /// was before the step.
  void step();
  /// Steps until that many seconds are over. Between steps signals are handled, and `progress` (None: no
  /// call) is called a few times per second with the share that is done.
  void run(double seconds, const pybind11::object& progress);

  double time() const { return cloth_.time(); }  ///< s
  bool settled() { return cloth_.simulation().settled(); }
  /// (V, 3), m and m/s: read-only views. Every call returns the same memory, filled with the state at that
  /// call. The views keep that memory alive.
  pybind11::array positions();
  pybind11::array velocities();
  pybind11::array triangles() const;  ///< (T, 3)
  pybind11::array masses() const;     ///< (V), kg
  pybind11::array pinned() const;     ///< (P): which vertices are pinned
  /// (P, 3), m: where the pinned vertices are at the end of the next step. Always the same memory, which may
  /// be written. Throws std::invalid_argument for a method that does not move pins.
  pybind11::array pins();
  /// (code, text) of each warning about the scene, as `bendlab run` prints it.
  std::vector<std::pair<std::string, std::string>> warnings() const { return warnings_; }

  /// J, by kind: "kinetic", "weight", and "strain" and each kind of bending constraint. A stiffness that is
  /// stated as k has no energy, and is absent.
  pybind11::dict energies();
  /// (V, 3), N, by kind, without forces of effects; 0 at pinned vertices.
  pybind11::dict forces();

 private:
  struct Arrays;
  class Use;

  void step_once();

  Cloth cloth_;
  bool has_python_parts_ = false;
  std::vector<std::pair<std::string, std::string>> warnings_;
  std::shared_ptr<HandMotion> hand_;  // null until pins() was called
  std::shared_ptr<Arrays> arrays_;
  std::atomic<bool> in_use_{false};
};

}  // namespace bendlab
