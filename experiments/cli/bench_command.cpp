#include <fmt/format.h>
#include <unistd.h>

#include "experiments/cli/commands.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"

namespace bendlab {

int bench_command(const BenchOptions& options, bool list, bool json) {
  const std::vector<BenchCase> cases = bench_cases(options);
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

}  // namespace bendlab
