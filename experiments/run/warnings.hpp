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
#include "bendlab/scene/built_scene.hpp"
#include "experiments/config/experiment.hpp"

namespace bendlab {

struct Warning {
  std::string code;        ///< stable: "unconverged", …
  std::string message;     ///< with the number, what it means and what helps
  double severity = 0;     ///< orders the warnings of a code: a larger one is worse
  std::string measured{};  ///< the number that is as bad as that, "48 %"; empty if the message has none
};

/// What a warning says of one run; a text alone has no number to be ordered by.
struct WarningText {
  WarningText(std::string text) : message(std::move(text)) {}
  WarningText(std::string text, double how_bad, std::string number)
      : message(std::move(text)), severity(how_bad), measured(std::move(number)) {}

  std::string message;  ///< severity and measured as in Warning
  double severity = 0;
  std::string measured;
};

/// What a warning may know.
struct WarningInput {
  const Experiment& experiment;
  const RunConfig& config;
  const BuiltScene& scene;
  const std::map<std::string, double>* summary = nullptr;  ///< of the run; null before it
  RunStatus status = RunStatus::running;                   ///< how it ended
};

struct WarningKind {
  std::string_view code;
  std::string_view meaning;  ///< when it is given
  bool before;               ///< known before the run: does not look at the summary
  std::optional<WarningText> (*message)(const WarningInput&);
};

/// Every kind, in the order in which they are printed.
std::span<const WarningKind> warning_kinds();

/// The warnings of a run; without a summary those that are known before it.
std::vector<Warning> warnings_of(const WarningInput& input);

/// [{code, message}, …] and back, with severity and measured where there is a number; other entries are left
/// out.
Json to_json(const std::vector<Warning>& warnings);
std::vector<Warning> warnings_of(const Json& json);

}  // namespace bendlab
