// Strict JSON, and the report of everything that is wrong with a config: all problems at once, each with its
// place.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace bendlab {

using Json = nlohmann::ordered_json;

/// A mistake in a config.
struct ConfigProblem {
  std::string pointer;  ///< JSON pointer to the offending value; "" is the config as a whole
  std::string message;  ///< what is wrong, what is allowed, the nearest name

  bool operator==(const ConfigProblem&) const = default;
};

using ConfigProblems = std::vector<ConfigProblem>;

/// Pointer to `key` of the object (or entry of the list) at `parent`, escaped.
std::string child_pointer(std::string_view parent, std::string_view key);

/// A JSON value as a text that is short enough for an error message.
std::string given_text(const Json& given);

/// All problems of a config at once; what() lists them line by line. Exit code 3.
class ConfigError : public std::runtime_error {
 public:
  ConfigError(std::string_view source, ConfigProblems problems);
  const ConfigProblems& problems() const { return problems_; }

 private:
  ConfigProblems problems_;
};

/// Reads JSON that must be UTF-8 without byte order mark, without duplicate keys, comments, non-finite
/// numbers or text after its end, and nested at most 64 deep. Appends what is wrong to `problems`. Text that
/// is not JSON is reported with line and column, and there is no document. A duplicate key is reported with
/// its pointer; its first value counts, so that the rest can be checked, too.
std::optional<Json> read_strict_json(std::string_view text, ConfigProblems& problems);

/// The same for a caller that checks nothing else. Throws ConfigError.
Json parse_strict_json(std::string_view text, std::string_view source_name);

}  // namespace bendlab
