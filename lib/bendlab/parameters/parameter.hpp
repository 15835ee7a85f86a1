// One row per setting: name, type, unit, default, range, meaning. The same rows parse a config, fill in its
// defaults and print `bendlab schema` and `bendlab models`; there is no second list.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace bendlab {

/// A setting's value after parsing. `std::monostate`: an optional setting that is not set.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>,
                           std::vector<std::string>>;

enum class ParameterType {
  boolean,
  integer,
  number,   ///< finite; lower and upper bound inclusive unless `above` is set
  text,     ///< free text (a path, a name), or one of `choices` if there are any
  numbers,  ///< list of finite numbers, of length `length` if that is not 0
  texts,    ///< list of texts, each one of `choices` if there are any
};

/// A setting's default. It is a literal type, so that tables of parameters are constant data.
struct Default {
  enum class Kind { none, boolean, integer, number, text, numbers, texts } kind = Kind::none;
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0;
  std::string_view text;
  std::span<const double> numbers;
  std::span<const std::string_view> texts;

  constexpr Default() = default;  ///< no default: the setting is optional and may be absent
  constexpr Default(bool value) : kind(Kind::boolean), boolean(value) {}
  constexpr Default(int value) : kind(Kind::integer), integer(value) {}
  constexpr Default(double value) : kind(Kind::number), number(value) {}
  constexpr Default(const char* value) : kind(Kind::text), text(value) {}
  constexpr Default(std::span<const double> value) : kind(Kind::numbers), numbers(value) {}
  constexpr Default(std::span<const std::string_view> value) : kind(Kind::texts), texts(value) {}
};

/// One setting. `minimum` and `maximum` bound integers, numbers and each entry of `numbers`.
struct Parameter {
  std::string_view name = {};
  ParameterType type = ParameterType::number;
  std::string_view unit = {};  ///< SI, "1" for a pure number, empty if a unit has no meaning
  Default default_value = {};
  std::string_view meaning = {};
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool above = false;     ///< the minimum itself is not allowed
  bool required = false;  ///< must be given; has no default
  std::span<const std::string_view> choices = {};
  std::size_t length = 0;
};

/// Tables joined into one, in order.
template <std::size_t... sizes>
constexpr auto joined(const std::array<Parameter, sizes>&... tables) {
  std::array<Parameter, (sizes + ...)> all{};
  std::size_t next = 0;
  const auto append = [&](const auto& table) {
    for (const Parameter& parameter : table) all[next++] = parameter;
  };
  (append(tables), ...);
  return all;
}

/// The default of a parameter as a value (`std::monostate` if it has none).
Value default_of(const Parameter& parameter);

/// Values of a table of parameters, by name. Reading a name that is not there, or as another type, is a
/// programming error and throws std::logic_error.
class ParameterValues {
 public:
  ParameterValues() = default;
  /// Every parameter of the table at its default.
  explicit ParameterValues(std::span<const Parameter> table);

  void set(std::string_view name, Value value);
  bool has(std::string_view name) const;  ///< known and not `std::monostate`
  const Value& value(std::string_view name) const;

  bool boolean(std::string_view name) const;
  std::int64_t integer(std::string_view name) const;
  double number(std::string_view name) const;  ///< reads an integer, too
  const std::string& text(std::string_view name) const;
  const std::vector<double>& numbers(std::string_view name) const;
  const std::vector<std::string>& texts(std::string_view name) const;

  const std::vector<std::pair<std::string, Value>>& all() const { return values_; }

 private:
  std::vector<std::pair<std::string, Value>> values_;  // sorted by name
};

}  // namespace bendlab
