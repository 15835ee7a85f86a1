#include "experiments/campaign/run_times.hpp"

#include <cmath>
#include <limits>

#include "bendlab/settings/median.hpp"
#include "experiments/run/needs.hpp"

namespace bendlab {
namespace {

double vertices_of(const RunConfig& config) {
  const std::optional<Needs> needs = needs_of(config);
  return needs ? needs->vertices : 1;
}

}  // namespace

void RunTimes::add(const RunConfig& config, double cpu_s) {
  finished_.push_back({std::string(config.scene().bending.model.name()),
                       std::string(config.scene().solver.method.name()), vertices_of(config),
                       cpu_s / crude_work(config)});
}

std::optional<RunTimes::Expected> RunTimes::expected(const RunConfig& config) const {
  const double vertices = vertices_of(config);
  double nearest = std::numeric_limits<double>::infinity();  // |ln| of the ratio of vertices
  std::vector<double> times;
  for (const Finished& run : finished_) {
    if (run.model != config.scene().bending.model.name() || run.method != config.scene().solver.method.name())
      continue;
    const double distance = std::abs(std::log(run.vertices / vertices));
    if (distance < nearest) nearest = distance, times.clear();
    if (distance == nearest) times.push_back(run.cpu_s_per_work);
  }
  if (times.empty()) return std::nullopt;
  const std::size_t finished = times.size();
  return Expected{crude_work(config) * median(std::move(times)), finished};
}

}  // namespace bendlab
