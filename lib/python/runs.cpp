#include "runs.hpp"

#include <pybind11/stl.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "experiments/campaign/campaign.hpp"
#include "experiments/campaign/sweep_file.hpp"
#include "readers.hpp"

namespace py = pybind11;

namespace bendlab {
namespace {

py::object python_of(const Json& value) {
  return py::module_::import("json").attr("loads")(value.dump());
}

py::dict row_of(const CampaignRun& run) {
  using namespace py::literals;
  py::dict row, point;
  for (const auto& [pointer, value] : run.config->point) point[py::str(pointer)] = python_of(value);
  row["experiment"] = run.experiment->name, row["point"] = point;
  row["status"] = "failed", row["message"] = run.error;
  if (!run.started()) row["status"] = "not started";
  if (!run.outcome) return row;
  const RunOutcome& outcome = *run.outcome;
  py::list warnings;
  for (const Warning& warning : outcome.warnings)
    warnings.append(py::make_tuple(warning.code, warning.message));
  row["status"] = std::string(to_string(outcome.status)), row["message"] = outcome.message;
  row["warnings"] = warnings, row["file"] = outcome.file.string(), row["cpu_s"] = outcome.cpu_s;
  row["summary"] = outcome.summary, row["reused"] = outcome.reused;
  return row;
}

// Computes the runs on another thread, so that Python can handle Ctrl-C.
class Watched {
 public:
  Watched(std::vector<CampaignRun>& runs, CampaignOptions options, const py::object& progress) {
    using namespace std::chrono_literals;
    options.stop = &stop_;
    std::thread worker([&] {
      try {
        run_campaign(runs, options, [&](std::size_t) { ++over_; });
      } catch (...) {
        thrown_ = std::current_exception();
      }
      const std::lock_guard lock(access_);
      done_ = true;
      changed_.notify_all();
    });
    try {
      for (bool done = false; !done;) {
        {
          const py::gil_scoped_release without_gil;
          std::unique_lock lock(access_);
          done = changed_.wait_for(lock, 50ms, [&] { return done_; });
        }
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (!progress.is_none()) progress(over_.load(), runs.size());
      }
    } catch (...) {
      stop_ = true;
      const py::gil_scoped_release without_gil;
      worker.join();
      throw;
    }
    const py::gil_scoped_release without_gil;
    worker.join();
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  std::atomic<bool> stop_{false};
  std::atomic<std::size_t> over_{0};
  std::exception_ptr thrown_;
  std::mutex access_;
  std::condition_variable changed_;
  bool done_ = false;
};

// `source`: the config's file, where relative paths start; empty: they start at the working directory.
py::list run(const std::string& config, const std::string& source, const std::string& out, int jobs,
             bool force, const py::object& progress) {
  const RegistryReader reader;
  std::vector<Experiment> experiments;
  {
    const py::gil_scoped_release without_gil;
    experiments.push_back(source.empty() ? parse_experiment(config, "run()") : parse_config(config, source));
    write(sweep_files(out, experiments));
  }
  std::vector<CampaignRun> runs = plan_campaign(experiments);
  Watched(runs, {.out = out, .jobs = jobs, .force = force, .tells_verdicts = false}, progress);
  py::list rows;
  for (const CampaignRun& planned : runs) rows.append(row_of(planned));
  return rows;
}

}  // namespace

void add_runs(py::module_& module) {
  using namespace py::literals;
  module.def("run", &run, "config"_a, "source"_a, "out"_a, "jobs"_a, "force"_a, "progress"_a);
}

}  // namespace bendlab
