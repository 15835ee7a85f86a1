// `bendlab bench`: measures what the solver costs on this machine.
#include "experiments/bench/bench.hpp"
#include "experiments/cli/command.hpp"

namespace bendlab {

namespace {

struct BenchCommand : Command {
  BenchOptions bench;

  BenchCommand() {
    add(bench.filter, "--filter REGEX",
        "Only benchmarks whose names match. The names of oracles (the scalar code) have '_oracle'");
    add(bench.quick, "--quick", "Small meshes and short repetitions: takes seconds instead of minutes");
    add(bench.repetitions, "--repetitions",
        "Number of repetitions, at least 2; median, lowest and highest value are reported", {2, 1000});
    add(bench.threads, "--threads", "Numbers of threads for benchmarks of whole steps, besides one thread",
        {1, 256});
    add(bench.list, "--list", "Only print the names of the benchmarks; measure nothing");
    add(bench.json, "--json", "Print the JSON of Google Benchmark");
    add(bench.flags, "[FLAGS]", "After --: further flags of Google Benchmark, such as --benchmark_out=FILE");
  }

  int run() override { return run_benchmarks(bench); }
};

}  // namespace

extern const CommandKind bench_command{"bench", "Measure what the solver costs on this machine",
                                       "bendlab bench --quick --filter strain", make<BenchCommand>};

}  // namespace bendlab
