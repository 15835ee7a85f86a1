// `bendlab bench` measures the cost of the solver on this machine.
//
// A row is one case: a kernel on a moving cloth, a step, the set-up, recording, a sweep, or a comparison of
// orders. A case has several repetitions, and Google Benchmark chooses how many calls a repetition makes. A
// row has the median, the smallest and the largest time of the repetitions. For a single thread, processor
// time is measured: other programs on the machine then affect only caches and clock rate.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

class Simulation;

struct BenchOptions {
  std::string filter;  ///< regular expression on ids; empty: all
  bool quick = false;  ///< small meshes and short repetitions, to test the benchmark
  int repetitions = 7;
  std::vector<int> threads = {1, 2};  ///< of whole steps
};

/// Median and range of the repetitions.
struct Spread {
  double median = std::numeric_limits<double>::quiet_NaN(), lowest = median, highest = median;
};
Spread spread_of(std::vector<double> values);

struct BenchRow {
  std::string name;    ///< "strain/128": kind of case, and the cells along each side
  std::string scalar;  ///< "float", "double"
  int threads = 1;
  std::int64_t vertices = 0, constraints = 0;
  /// Time per constraint and projection (set-up: per spring; methods: per vertex and iteration).
  Spread ns;
  int repetitions = 0;                      ///< 0: nothing is timed
  std::optional<double> ratio_to_oracle;    ///< median of the oracle / median of this row
  std::optional<double> roofline_fraction;  ///< least possible time (see roofline.hpp) / median
  Json more = Json::object();               ///< other values, with the unit at the end of each key
};

/// One row to be measured. Successive cases may share a scene.
struct BenchCase {
  std::string id;        ///< name/scalar, and /threads:N from two on
  std::string oracle{};  ///< id of the oracle's case; empty: no oracle
  std::function<BenchRow()> run;
};

/// Strain, crossover springs, dense rings and whole steps on a moving cloth, and their oracles.
std::vector<BenchCase> cloth_cases(const BenchOptions& options);

/// Time of each effect's passes in a step, per vertex and per action of the effect, for several sizes.
std::vector<BenchCase> effect_cases(const BenchOptions& options);

/// An iteration of each solver method, per vertex, for several sizes; also gradient and solve of quasi_newton
/// alone.
std::vector<BenchCase> method_cases(const BenchOptions& options);

/// Seconds and peak memory of setting up the rings, pairs, colours and batches of `adaptive`.
std::vector<BenchCase> set_up_cases(const BenchOptions& options);

/// The time that recording adds to a run, and the time of eight runs with one job and with two.
std::vector<BenchCase> run_cases(const BenchOptions& options);

/// Strain errors that the orders `colour` and `mesh` leave after the same number of rounds over the
/// constraints.
std::vector<BenchCase> convergence_cases(const BenchOptions& options);

/// `name/scalar[/threads:N]`.
std::string bench_id(const std::string& name, const std::string& scalar, int threads = 1);

/// Seconds per call of `measure`, which does one iteration and returns its seconds. Each of the `repetitions`
/// repetitions lasts at least `least_s` seconds (0: one call).
Spread repeated(const std::string& id, int repetitions, double least_s,
                const std::function<double()>& measure);

/// Nanoseconds per item, if `count` items took `seconds` together.
Spread ns_per(double count, const Spread& seconds);

/// Seconds of a step: processor time of this thread, and wall time.
struct StepSeconds {
  double cpu, wall;
};
/// Throws std::runtime_error if the cloth diverged.
StepSeconds timed_step(Simulation& simulation);

/// The cases that the options choose, and the oracles of these cases. Throws UsageError if the filter is no
/// regular expression or chooses no case.
std::vector<BenchCase> bench_cases(const BenchOptions& options);

/// Runs the cases in order; `on_start` is called with the id of each case. A case that throws gives no row:
/// `on_failure` gets its id and the reason, and the next case runs.
std::vector<BenchRow> run_bench(
    const std::vector<BenchCase>& cases, const std::function<void(const std::string& id)>& on_start,
    const std::function<void(const std::string& id, const std::string& why)>& on_failure);

/// Host, processor, compiler, flags, vector width, date, bandwidths and peak rates.
Json bench_context();

/// {"context": {…}, "rows": [{…}, …]}, a row per line.
std::string bench_json(const std::vector<BenchRow>& rows);

/// A table for a terminal.
std::string bench_text(const std::vector<BenchRow>& rows);

}  // namespace bendlab
