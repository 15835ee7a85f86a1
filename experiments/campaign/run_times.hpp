// The time of runs that are not computed yet, from the runs of the same sweep that are finished.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/run_config.hpp"

namespace bendlab {

class RunTimes {
 public:
  /// Adds a finished run, with the CPU time that it took.
  void add(const RunConfig& config, double cpu_s);

  struct Expected {
    double cpu_s = 0;
    std::size_t finished = 0;  ///< number of finished runs that the time rests on
  };
  /// The work of the run (crude_work()), times the median time per work of the finished runs with the same
  /// bending model and method and, among these, the nearest number of vertices. Nothing if there are none.
  std::optional<Expected> expected(const RunConfig& config) const;

 private:
  struct Finished {
    std::string model, method;
    double vertices = 0, cpu_s_per_work = 0;
  };
  std::vector<Finished> finished_;
};

}  // namespace bendlab
