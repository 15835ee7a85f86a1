// A warning of a run, kept in its file and told at its end, and what it is found from.
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

/// [{code, message}, …] and back, with severity and measured where there is a number; other entries are left
/// out.
Json to_json(const std::vector<Warning>& warnings);
std::vector<Warning> warnings_of(const Json& json);

}  // namespace bendlab
