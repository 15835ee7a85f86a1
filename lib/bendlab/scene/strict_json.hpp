// Strict JSON, and how everything wrong with a config is reported: each problem with its place, all at once.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace bendlab {

using Json = nlohmann::ordered_json;

/// One thing wrong with a config.
struct ConfigProblem {
  std::string pointer;  ///< JSON pointer to the offending value; "" is the config as a whole
  std::string message;  ///< what is wrong, what is allowed, the nearest name

  bool operator==(const ConfigProblem&) const = default;
};

using ConfigProblems = std::vector<ConfigProblem>;

/// Pointer to `key` of the object (or entry of the list) at `parent`, escaped.
std::string child_pointer(std::string_view parent, std::string_view key);

/// What was given, short enough for a message.
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
/// numbers or text after its end, and nested at most 64 deep. Appends what is wrong to `problems`: text that
/// is not JSON with line and column, and then there is no document; a duplicate key with its pointer (the
/// first one counts, so that the rest can be checked too).
std::optional<Json> read_strict_json(std::string_view text, ConfigProblems& problems);

/// The same for a caller with nothing further to check. Throws ConfigError.
Json parse_strict_json(std::string_view text, std::string_view source_name);

}  // namespace bendlab
