// `bendlab bench`: measures what the solver costs on this machine.
#include <fmt/format.h>
#include <unistd.h>

#include "experiments/bench/bench.hpp"
#include "experiments/cli/command.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"

namespace bendlab {

namespace {

struct BenchCommand : Command {
  BenchOptions bench;
  bool list = false;

  BenchCommand() {
    add(bench.filter, "--filter REGEX",
        "Only benchmarks whose names match, and their oracles (the scalar code)");
    add(bench.quick, "--quick", "Small meshes and short repetitions: takes seconds instead of minutes");
    add(bench.repetitions, "--repetitions", "Number of repetitions; the median is reported", {1, 1000});
    add(bench.threads, "--threads", "Numbers of threads for benchmarks of whole steps, besides one thread",
        {1, 256});
    add(list, "--list", "Only print the names of the benchmarks; measure nothing");
    add(json, "--json", "Print JSON: the context, and one object per row");
  }

  int run() override {
    const std::vector<BenchCase> cases = bench_cases(bench);
    if (list) {
      for (const BenchCase& bench_case : cases) print_text("{}\n", bench_case.id);
      return exit_ok;
    }
    const bool show_progress = isatty(STDERR_FILENO) != 0;
    std::size_t done = 0;
    int code = exit_ok;
    const auto show = [&](const std::string& id) {
      if (show_progress) print_text(stderr, "\r\033[K[{}/{}] {}", ++done, cases.size(), id);
    };
    const auto report = [&](const std::string& id, const std::string& why) {
      print_text(stderr, "{}bendlab: {}: not measured: {}\n", show_progress ? "\r\033[K" : "", id, why);
      code = exit_failed;
    };
    const std::vector<BenchRow> rows = run_bench(cases, show, report);
    if (show_progress) print_text(stderr, "\r\033[K");
    print_text("{}", json ? bench_json(rows) : bench_text(rows));
    return code;
  }
};

}  // namespace

extern const CommandKind bench_command{"bench", "Measure what the solver costs on this machine",
                                       "bendlab bench --quick --filter strain", make<BenchCommand>};

}  // namespace bendlab
