// Warnings about a run that has no error, but may not be what the user meant. A warning states a value and a
// remedy. To add a warning, write a function and a row in warnings.cpp.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "experiments/run/warning.hpp"

namespace bendlab {

struct WarningKind {
  std::string_view code;
  std::string_view meaning;  ///< when it is given
  bool before;               ///< known before the run: does not read the summary
  std::optional<WarningText> (*message)(const WarningInput&);
};

/// Every kind, in the order in which warnings are printed.
std::span<const WarningKind> warning_kinds();

/// The warnings of a run; without a summary, those that are known before the run.
std::vector<Warning> warnings_of(const WarningInput& input);

}  // namespace bendlab
