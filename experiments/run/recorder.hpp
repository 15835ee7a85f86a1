// Makes the frames of a run, and calls its measures.
#pragma once

#include <memory>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "bendlab/metrics/stretch.hpp"
#include "experiments/measures/measure.hpp"
#include "experiments/run/plausibility.hpp"

namespace bendlab {

class Recorder {
 public:
  /// Begins the measures of the run. Both arguments must outlive the recorder. Throws ConfigError if a
  /// measure does not fit the scene.
  Recorder(const RunConfig& config, const BuiltScene& scene);

  const std::vector<Column>& metrics() const { return columns_; }     ///< of Frame::metrics
  const std::vector<Column>& cell_fields() const { return fields_; }  ///< of Frame::cell_fields

  /// To be called at time 0 and after every step.
  void step(const Simulation& simulation, const Moment& moment);

  /// A frame with its time, its positions, and the metrics that need more than positions. To be called
  /// between steps.
  Frame capture(const Simulation& simulation) const;

  /// Computes all other values of the frame, and checks the frame's plausibility. Runs on the writer's
  /// thread, for one frame after another.
  void complete(Frame& frame, Plausibility& plausibility);

  /// Writes or reads the state of the measures. To be called between steps, when all frames are complete. The
  /// metrics of earlier frames are in the run file: see take_earlier().
  void archive(Archive& state);
  /// Reads the metrics of the first frames of a run file.
  void take_earlier(const EarlierFrames& earlier);

  /// Findings of the measures that make other runs if `of_those_that_make_runs`, else of all other measures.
  /// To be called when all frames are complete.
  Findings findings(const RunEnd& end, bool of_those_that_make_runs);

  FrameHistory history() const { return {columns_, times_, rows_, has_motion_}; }

 private:
  struct Active {
    const Measure* measure;
    std::unique_ptr<Measurement> measurement;
    std::size_t column, columns, field, fields;  // first index and count in a frame
  };

  std::vector<Active> active_;
  std::vector<Column> columns_, fields_;
  StretchMeter stretch_;
  bool has_motion_;                        // of the method
  std::vector<double> times_;              // s
  std::vector<std::vector<double>> rows_;  // metrics of the completed frames
};

/// Metrics of the scene and of the solver, which every run's summary has.
std::map<std::string, double> facts_of(const BuiltScene& scene, const Simulation& simulation);

}  // namespace bendlab
