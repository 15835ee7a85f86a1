// Measures: what is found out about a run. Each is one file here and its name in the list of measure.cpp, and
// nothing else knows it; a program that uses this library may register its own. A run has those that every
// run has, and those that its config asks for; the others cost it nothing.
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

/// A recorded frame. What several measures need is computed once, when the first asks for it.
class MeasuredFrame {
 public:
  /// `values` of `columns`, filled in as the measures come to it. All must outlive this.
  MeasuredFrame(double time, const Positions& positions, const StretchMeter& meter,
                std::span<const Column> columns, std::span<const double> values)
      : time_(time), positions_(positions), meter_(meter), columns_(columns), values_(values) {}

  double time() const { return time_; }                      ///< s
  const Positions& positions() const { return positions_; }  ///< #V by 3, m
  const std::vector<PrincipalStretches>& stretches() const;  ///< #T
  const StretchSummary& stretch() const;
  /// What a measure that comes earlier in measures() gave for this frame. Throws std::logic_error for a
  /// column that no measure of this run has.
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

/// The values of all recorded frames, for measures that sum them up at the end.
class FrameHistory {
 public:
  /// Without motion the frames are the steps of a method towards an equilibrium, and only the last counts.
  FrameHistory(std::span<const Column> columns, std::span<const double> times,
               std::span<const std::vector<double>> rows, bool has_motion)
      : columns_(columns), times_(times), rows_(rows), has_motion_(has_motion) {}

  bool empty() const { return rows_.empty(); }
  /// Of a column, as MeasuredFrame::value() names it.
  double last(std::string_view column) const;
  double largest(std::string_view column) const;
  /// The median over the last simulated second: sheets are chaotic, and one frame misleads. Without motion
  /// last().
  double last_second_median(std::string_view column) const;

 private:
  double median(std::string_view column, std::size_t first) const;  // from that frame on

  std::span<const Column> columns_;
  std::span<const double> times_;  // s
  std::span<const std::vector<double>> rows_;
  bool has_motion_;
};

/// The place of a step in its run.
struct Moment {
  bool is_start = false;     ///< time 0, before the first step
  bool is_recorded = false;  ///< the pose is a frame of the file
  bool is_last = false;      ///< the run ends here
};

/// A run that a measure asked for: see RunEnd::other_run.
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
  /// Computes another run, or finds it complete; `start` may be null.
  std::function<OtherRun(const RunConfig& config, const StartingPose* start)> other_run;
};

/// What a measure found.
struct Findings {
  std::map<std::string, double> summary;  ///< numbers by name; each is in the measure's table
  std::vector<std::string> messages;      ///< why a number is missing
  bool stopped = false;                   ///< a signal came before all was known
};

/// A measure at work on one run.
class Measurement {
 public:
  virtual ~Measurement() = default;
  /// At time 0 and after every step, between steps.
  virtual void step(const Simulation&, const Moment&) {}
  /// Measures what needs more of a frame than its positions. Runs between steps, so it should be cheap.
  /// `values`: the measure's columns.
  virtual void capture(const Simulation&, const Positions&, std::span<double> /*values*/) {}
  /// Measures the rest of each frame, in order, on another thread in parallel with the steps. `fields`: one
  /// value per triangle for each of the measure's fields.
  virtual void complete(const MeasuredFrame&, std::span<double> /*values*/,
                        std::span<std::vector<float>> /*fields*/) {}
  /// When the run is over and all frames are complete.
  virtual void finish(const RunEnd&, Findings&) {}
  /// Writes or reads what step(), capture() and complete() keep; between steps, all frames being complete. A
  /// run that was stopped goes on with it.
  virtual void archive(Archive&) {}
};

/// Measure::begin of a class that is made from config and scene.
template <class Made>
std::unique_ptr<Measurement> begun(const RunConfig& config, const BuiltScene& scene) {
  return std::make_unique<Made>(config, scene);
}

/// A number that a measure gives at the end of a run.
using Quantity = Column;

inline std::vector<Column> no_columns() {
  return {};
}

struct Measure {
  std::string_view name;
  std::string_view summary;  ///< a line: what it finds out
  std::string_view cost;     ///< a line: what that takes
  /// Whether a run has it. Null for those on request, which a run has if /output/measures names them.
  bool (*applies)(const RunConfig&, const BuiltScene&) = nullptr;
  std::string_view when = "where it applies";  ///< a few words, unless that is always or on request
  std::function<std::vector<Column>()> columns = no_columns;  ///< of every frame: names, units, meanings
  std::function<std::vector<Column>()> fields = no_columns;   ///< of every triangle of every frame
  /// Of the run; a number without a meaning there is left out.
  std::function<std::vector<Quantity>()> gives = no_columns;
  /// It makes other runs, whose time is not this run's.
  bool makes_runs = false;
  /// Config and scene outlive the measurement. Throws ConfigError if the scene cannot be measured like this.
  std::function<std::unique_ptr<Measurement>(const RunConfig&, const BuiltScene&)> begin = nullptr;
  /// Of an added one: tells versions of its code apart, in run ids. Empty: the program's file does.
  std::string_view code = {};
};

/// All, in the order in which they look at a frame and stand in the run file; then those that the program
/// added.
std::span<const Measure* const> measures();

/// Adds a measure of the program's own, which has to stay where it is. See Registry::add(). Throws
/// std::invalid_argument if its name or one of its numbers' is taken or it has no begin().
void register_measure(const Measure& measure);
void register_measure(const Measure&&) = delete;
/// Takes one out that was added.
void remove_measure(std::string_view name);

/// The measures that the program added.
std::span<const Measure* const> added_measures();

/// Numbers of the scene and of the solver, which no measure gives: those of facts_of() and of the stepping.
std::span<const Column> numbers_of_scene();

/// Whether /output/measures names the measure.
bool is_asked_for(const Measure& measure, const RunConfig& config);

/// Whether a run of `config` on `scene` has the measure.
bool applies(const Measure& measure, const RunConfig& config, const BuiltScene& scene);

/// `applies` of a measure that every run has.
bool always(const RunConfig&, const BuiltScene&);

}  // namespace bendlab
