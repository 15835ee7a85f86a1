// The frames of a run, and the measures that look at them.
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
  /// Begins the measures that the run has. Both arguments must outlive the recorder. Throws ConfigError if
  /// the scene cannot be measured as the config asks.
  Recorder(const RunConfig& config, const BuiltScene& scene);

  const std::vector<Column>& metrics() const { return columns_; }     ///< of Frame::metrics
  const std::vector<Column>& cell_fields() const { return fields_; }  ///< of Frame::cell_fields

  /// Between steps, at time 0 and after each.
  void step(const Simulation& simulation, const Moment& moment);

  /// A frame with time, positions and what needs more than these; between steps.
  Frame capture(const Simulation& simulation) const;

  /// The rest of the frame, which the verdict sees too; on the writer's thread, one frame at a time, in
  /// order.
  void complete(Frame& frame, Plausibility& plausibility);

  /// Writes or reads what the measures keep between steps; all frames being complete. Their values of earlier
  /// frames are in the run file: see take_earlier().
  void archive(Archive& state);
  /// Takes the values of the first frames of a run file.
  void take_earlier(const EarlierFrames& earlier);

  /// To be called when all frames are complete: what was found by the measures that make other runs, or by
  /// those that make none.
  Findings findings(const RunEnd& end, bool of_those_that_make_runs);

  FrameHistory history() const { return {columns_, times_, rows_, has_motion_}; }

 private:
  struct Active {
    const Measure* measure;
    std::unique_ptr<Measurement> measurement;
    std::size_t column, columns, field, fields;  // its place in the frame, and how many it has
  };

  std::vector<Active> active_;
  std::vector<Column> columns_, fields_;
  StretchMeter stretch_;
  bool has_motion_;                        // of the method
  std::vector<double> times_;              // s
  std::vector<std::vector<double>> rows_;  // metrics of the completed frames
};

/// Numbers that every run's summary has, of the scene and of what the solver did.
std::map<std::string, double> facts_of(const BuiltScene& scene, const Simulation& simulation);

}  // namespace bendlab
