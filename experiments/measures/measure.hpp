// A measure computes metrics of a run. A new measure needs one file in this folder and its name in the list
// of measure.cpp, and no other change. A program that uses this library may register its own measures. A run
// has the measures that apply to every run, and the measures that its config names. No other measure is
// computed.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "bendlab/metrics/stretch.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/scene/start_after.hpp"
#include "experiments/config/run_config.hpp"

namespace bendlab {

/// A recorded frame. Values that several measures need are computed only once, on first use.
class MeasuredFrame {
 public:
  /// `values` has a value for each metric in `columns`. The measures fill in these values one after another.
  /// All arguments must outlive this object.
  MeasuredFrame(double time, const Positions& positions, const StretchMeter& meter,
                std::span<const Column> columns, std::span<const double> values)
      : time_(time), positions_(positions), meter_(meter), columns_(columns), values_(values) {}

  double time() const { return time_; }                      ///< s
  const Positions& positions() const { return positions_; }  ///< #V by 3, m
  const std::vector<PrincipalStretches>& stretches() const;  ///< #T
  const StretchSummary& stretch() const;
  /// The value of the metric `column` in this frame. The measure of this metric must come before the calling
  /// measure in measures(). Throws std::logic_error for a metric that no measure of this run has.
  double value(std::string_view column) const;

 private:
  double time_;
  const Positions& positions_;
  const StretchMeter& meter_;
  std::span<const Column> columns_;
  std::span<const double> values_;
  mutable std::optional<std::vector<PrincipalStretches>> stretches_;
  mutable std::optional<StretchSummary> stretch_;
};

/// The metrics of all recorded frames, for measures that summarise these metrics at the end.
class FrameHistory {
 public:
  /// If not `has_motion`, the frames are the steps of a method towards an equilibrium, and only the last
  /// frame is used.
  FrameHistory(std::span<const Column> columns, std::span<const double> times,
               std::span<const std::vector<double>> rows, bool has_motion)
      : columns_(columns), times_(times), rows_(rows), has_motion_(has_motion) {}

  bool empty() const { return rows_.empty(); }
  double last(std::string_view column) const;
  double largest(std::string_view column) const;
  /// The median over the last simulated second. A single frame would mislead, because sheets move
  /// chaotically. Without motion, the value in the last frame.
  double last_second_median(std::string_view column) const;

 private:
  double median(std::string_view column, std::size_t first) const;  // over the frames from `first` on

  std::span<const Column> columns_;
  std::span<const double> times_;  // s
  std::span<const std::vector<double>> rows_;
  bool has_motion_;
};

/// Whether a step is at the start or the end of a run, and whether its pose is recorded.
struct Moment {
  bool is_start = false;     ///< time 0, before the first step
  bool is_recorded = false;  ///< the pose is a frame of the file
  bool is_last = false;      ///< the run ends here
};

/// Another run that a measure needs: see RunEnd::other_run.
struct OtherRun {
  RunStatus status = RunStatus::complete;
  std::filesystem::path file;
  std::map<std::string, double> summary;
  std::string message;
};

/// A run that is over.
struct RunEnd {
  RunStatus status = RunStatus::complete;
  const std::string& id;
  const Simulation& simulation;  ///< in its last pose; useless if the run diverged
  const FrameHistory& frames;
  /// Computes another run, or reads the file of this run if it is complete; `start` may be null.
  std::function<OtherRun(const RunConfig& config, const StartingPose* start)> other_run;
};

/// The results of a measure at the end of a run.
struct Findings {
  std::map<std::string, double> summary;  ///< metrics by name; Measure::gives lists them
  std::vector<std::string> messages;      ///< why a metric is missing
  bool stopped = false;                   ///< a signal came before all metrics were known
};

/// The work of a measure for one run.
class Measurement {
 public:
  virtual ~Measurement() = default;
  /// Called at time 0 and after every step.
  virtual void step(const Simulation&, const Moment&) {}
  /// Computes the metrics of a frame that need more than positions. The next step waits for this function, so
  /// it should be fast. `values` has one value per metric in Measure::columns, in the same order.
  virtual void capture(const Simulation&, const Positions&, std::span<double> /*values*/) {}
  /// Computes all metrics of a frame that capture() does not compute, on another thread, for one frame after
  /// another. `fields` gets one value per triangle for every field of the measure.
  virtual void complete(const MeasuredFrame&, std::span<double> /*values*/,
                        std::span<std::vector<float>> /*fields*/) {}
  /// Called when the run is over and all frames are complete.
  virtual void finish(const RunEnd&, Findings&) {}
  /// Writes or reads the state of this object, so that a stopped run can continue. Called between steps, when
  /// all frames are complete.
  virtual void archive(Archive&) {}
};

/// A Measure::begin that makes an object of the class `Made` from config and scene.
template <class Made>
std::unique_ptr<Measurement> begun(const RunConfig& config, const BuiltScene& scene) {
  return std::make_unique<Made>(config, scene);
}

/// A metric that a measure gives at the end of a run.
using Quantity = Column;

inline std::vector<Column> no_columns() {
  return {};
}

struct Measure {
  std::string_view name;
  std::string_view summary;  ///< one line: what it measures
  std::string_view cost;     ///< one line: the time or memory that it takes
  /// Whether a run has the measure. If null, a run has the measure only if /output/measures names it.
  bool (*applies)(const RunConfig&, const BuiltScene&) = nullptr;
  /// States in a few words when `applies` is true. Not printed if `applies` is null or always true.
  std::string_view when = "where it applies";
  std::function<std::vector<Column>()> columns = no_columns;  ///< metrics of every frame
  std::function<std::vector<Column>()> fields = no_columns;   ///< metrics of every triangle of every frame
  /// Metrics of the run. The summary of a run leaves out metrics that have no meaning in the run.
  std::function<std::vector<Quantity>()> gives = no_columns;
  /// The measure makes other runs. The time of these other runs is not added to the time of the measured run.
  bool makes_runs = false;
  /// Config and scene outlive the measurement. Throws ConfigError if this measure does not fit the scene.
  std::function<std::unique_ptr<Measurement>(const RunConfig&, const BuiltScene&)> begin = nullptr;
  /// Only for a measure that a program added: a text that differs between versions of the measure's code. It
  /// becomes a part of run ids. If empty, the hash of the program's file is used instead.
  std::string_view code = {};
};

/// All measures, in the order in which they measure a frame and in which the run file stores their metrics.
/// Measures that the program added come last.
std::span<const Measure* const> measures();

/// Adds a measure of the program. The address of `measure` must stay valid (see Registry::add()). Throws
/// std::invalid_argument if the measure has no begin(), or if its name or the name of a metric is already in
/// use.
void register_measure(const Measure& measure);
void register_measure(const Measure&&) = delete;
/// Removes a measure that the program added.
void remove_measure(std::string_view name);

/// The measures that the program added.
std::span<const Measure* const> added_measures();

/// Metrics of the scene and of the solver, which no measure computes. facts_of() computes all of them except
/// settled_at, which step_to_end() returns.
std::span<const Column> numbers_of_scene();

/// Whether /output/measures names the measure.
bool is_asked_for(const Measure& measure, const RunConfig& config);

/// Whether a run of `config` on `scene` has the measure.
bool applies(const Measure& measure, const RunConfig& config, const BuiltScene& scene);

/// The function that a measure of every run uses as Measure::applies.
bool always(const RunConfig&, const BuiltScene&);

}  // namespace bendlab
