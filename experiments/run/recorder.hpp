// What is measured of every recorded frame, in one list: names, units, meanings and values side by side.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "bendlab/metrics/stretch.hpp"
#include "experiments/run/plausibility.hpp"
#include "experiments/scene/scene.hpp"

namespace bendlab {

class Recorder {
 public:
  /// `scene` must outlive the recorder.
  explicit Recorder(const Scene& scene);

  std::vector<Column> metrics() const;      ///< of Frame::metrics
  std::vector<Column> cell_fields() const;  ///< of Frame::cell_fields

  /// A frame with time, positions and what needs velocities; cheap, on the solver's thread.
  Frame capture(const Simulation& simulation) const;

  static double kinetic_energy_of(const Frame& frame);  ///< J

  /// Shows a completed frame's stretches to the verdict; on the writer's thread too.
  void show(const Frame& frame, Plausibility& plausibility) const;

  /// The rest of the frame, from its positions; on the writer's thread, one frame at a time, in order.
  void complete(Frame& frame);

  /// The run's summary from the frames completed so far: last frame, medians over the last simulated second,
  /// extremes.
  std::map<std::string, double> summary(const Simulation& simulation) const;

 private:
  double last_second_median(std::size_t column) const;

  const Scene& scene_;
  StretchMeter stretch_;
  double pin_level_ = 0;  // of the highest pin, along `down`
  std::vector<double> times_;
  std::vector<std::vector<double>> rows_;  // metrics of the completed frames
};

}  // namespace bendlab
