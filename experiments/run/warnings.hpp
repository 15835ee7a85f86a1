// What a colleague would say about a run that is not wrong, but may not be what was meant: each with its
// number and a remedy. A new warning is a function and a row in warnings.cpp.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "experiments/config/config.hpp"
#include "experiments/scene/scene.hpp"

namespace bendlab {

struct Warning {
  std::string code;     ///< stable: "unconverged", …
  std::string message;  ///< with the number, what it means and what helps
};

/// What a warning may know.
struct WarningInput {
  const Experiment& experiment;
  const RunConfig& config;
  const Scene& scene;
  const std::map<std::string, double>* summary = nullptr;  ///< of the run; null before it
  RunStatus status = RunStatus::running;                   ///< how it ended
};

struct WarningKind {
  std::string_view code;
  std::string_view meaning;  ///< when it is given
  bool before;               ///< known before the run: does not look at the summary
  std::optional<std::string> (*message)(const WarningInput&);
};

/// Every kind, in the order in which they are printed.
std::span<const WarningKind> warning_kinds();

/// The warnings of a run; without a summary those that are known before it.
std::vector<Warning> warnings_of(const WarningInput& input);

/// [{code, message}, …], and back; other entries are left out.
Json to_json(const std::vector<Warning>& warnings);
std::vector<Warning> warnings_of(const Json& json);

}  // namespace bendlab
