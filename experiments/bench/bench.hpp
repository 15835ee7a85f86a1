// `bendlab bench`: what the solver costs, measured on this machine.
//
// A row is one case: a kernel on a moving cloth, a step, the set-up, recording, a sweep, or a comparison of
// orders. Google Benchmark chooses how often a case is repeated within a repetition; of the repetitions the
// median, the smallest and the largest are kept. Where one thread works, its processor time counts: other
// programs on the machine then cost cache and clock rate, but no time.
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
  bool quick = false;  ///< small meshes and short repetitions, to test that it works
  int repetitions = 7;
  std::vector<int> threads = {1, 2};  ///< of the whole steps
};

/// Median and range of the repetitions.
struct Spread {
  double median = std::numeric_limits<double>::quiet_NaN(), lowest = median, highest = median;
};
Spread spread_of(std::vector<double> values);

struct BenchRow {
  std::string name;    ///< "strain/128": what, and the cells along each side
  std::string scalar;  ///< "float", "double"
  int threads = 1;
  std::int64_t vertices = 0, constraints = 0;
  /// Per constraint and projection (set-up: per spring; methods: per vertex and iteration).
  Spread ns;
  int repetitions = 0;                      ///< 0: nothing is timed
  std::optional<double> ratio_to_oracle;    ///< the oracle's median / this one's: how many times as fast
  std::optional<double> roofline_fraction;  ///< least possible time (see roofline.hpp) / median
  Json more = Json::object();               ///< other numbers, with the unit at the end of each key
};

/// One row to be measured. Cases that follow one another may share a scene.
struct BenchCase {
  std::string id;        ///< name/scalar, and /threads:N from two on
  std::string oracle{};  ///< id of the case it is compared with; empty: none
  std::function<BenchRow()> run;
};

/// Strain, crossover springs, dense rings and whole steps on a cloth that moves; the oracle beside them.
std::vector<BenchCase> cloth_cases(const BenchOptions& options);

/// Time of each effect's passes in a step, per vertex and per action, over sizes.
std::vector<BenchCase> effect_cases(const BenchOptions& options);

/// An iteration of each solver method, per vertex, over sizes; gradient and solve of quasi_newton apart.
std::vector<BenchCase> method_cases(const BenchOptions& options);

/// Rings, pairs, colours and batches of `adaptive`: seconds and peak memory.
std::vector<BenchCase> set_up_cases(const BenchOptions& options);

/// Recording beside stepping, and a sweep with one job and with two.
std::vector<BenchCase> run_cases(const BenchOptions& options);

/// Strain error after the same number of sweeps, order `colour` against `mesh`.
std::vector<BenchCase> convergence_cases(const BenchOptions& options);

/// `name/scalar[/threads:N]`.
std::string bench_id(const std::string& name, const std::string& scalar, int threads = 1);

/// Runs `measure`, which returns the seconds of one iteration, in `repetitions` of at least `least_s` seconds
/// each (0: one iteration), and gives seconds per iteration.
Spread repeated(const std::string& id, int repetitions, double least_s,
                const std::function<double()>& measure);

/// ns for each of `count` pieces of work that took so long together.
Spread ns_per(double count, const Spread& seconds);

/// Seconds of a step: processor time of this thread, and wall time.
struct StepSeconds {
  double cpu, wall;
};
/// Throws std::runtime_error if the cloth diverged.
StepSeconds timed_step(Simulation& simulation);

/// The cases that the options choose, and the oracles that these are compared with. Throws UsageError if the
/// filter is no regular expression or chooses nothing.
std::vector<BenchCase> bench_cases(const BenchOptions& options);

/// Runs them in order; `on_start` is called with each id. A case that throws gives no row: `on_failure` gets
/// its id and the reason, and the others go on.
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
