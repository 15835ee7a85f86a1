// A warning about a run, which is written to the run's file and printed, and the input of the functions that
// give warnings.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

struct BuiltScene;
struct Experiment;
class RunConfig;

struct Warning {
  std::string code;        ///< stable: "unconverged", …
  std::string message;     ///< with the measured value, its meaning and a remedy
  double severity = 0;     ///< orders warnings of the same code: larger is worse
  std::string measured{};  ///< the value that gives the severity, "48 %"; empty if there is none
};

/// The text of a warning. The severity is optional.
struct WarningText {
  WarningText(std::string text) : message(std::move(text)) {}
  WarningText(std::string text, double how_bad, std::string number)
      : message(std::move(text)), severity(how_bad), measured(std::move(number)) {}

  std::string message;  ///< severity and measured as in Warning
  double severity = 0;
  std::string measured;
};

/// The input of a function that may give a warning.
struct WarningInput {
  const Experiment& experiment;
  const RunConfig& config;
  const BuiltScene& scene;
  const std::map<std::string, double>* summary = nullptr;  ///< of the run; null before the run
  RunStatus status = RunStatus::running;                   ///< verdict of the run
};

/// Writes warnings as [{code, message}, …], with severity and measured if a warning has them, and reads this
/// JSON. Reading skips entries of any other form.
Json to_json(const std::vector<Warning>& warnings);
std::vector<Warning> warnings_of(const Json& json);

}  // namespace bendlab
