// `bendlab bench` measures the cost of the solver on this machine, with Google Benchmark.
//
// A benchmark measures a kernel on a moving cloth, a step, the set-up, recording, a sweep, or a limit of the
// machine. For a single thread, processor time is measured: other programs on the machine then affect only
// caches and clock rate.
#pragma once

#include <string>
#include <vector>

namespace bendlab {

struct BenchOptions {
  std::string filter = ".";  ///< regular expression on names
  bool quick = false;        ///< small meshes and short repetitions, to test the benchmark
  int repetitions = 7;
  std::vector<int> threads = {1, 2};  ///< of whole steps
  bool list = false;                  ///< only print the names
  bool json = false;                  ///< print JSON instead of a table
  std::vector<std::string> flags;     ///< further flags of Google Benchmark
};

/// Measures the benchmarks whose names match the filter, and prints the median, the lowest and the highest
/// value of the repetitions. Returns the exit code of the program.
int run_benchmarks(const BenchOptions& options);

}  // namespace bendlab
