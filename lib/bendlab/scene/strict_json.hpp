// Reads strict JSON, and collects all problems of a config with their positions.
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
  std::string pointer;  ///< JSON pointer to the wrong value; "" is the config as a whole
  std::string message;  ///< what is wrong, what is allowed, perhaps a similar name

  bool operator==(const ConfigProblem&) const = default;
};

using ConfigProblems = std::vector<ConfigProblem>;

/// The JSON pointer to the key or list index `key` of the value at `parent`; escapes special characters.
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

/// Reads JSON with strict rules: UTF-8 without byte order mark, no duplicate keys, no comments, only finite
/// numbers, no text after the document, and at most 64 levels of nesting. Appends all problems. If the text
/// is not JSON, the problem contains line and column, and nothing is returned. For a duplicate key, the
/// problem contains the pointer, and the first value is used, so that the rest of the document can be
/// checked.
std::optional<Json> read_strict_json(std::string_view text, ConfigProblems& problems);

/// Like read_strict_json(), but throws ConfigError if there is a problem.
Json parse_strict_json(std::string_view text, std::string_view source_name);

}  // namespace bendlab
