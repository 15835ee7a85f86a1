// A command of the program: its texts, its options, and what it does. All three are in the command's file;
// arguments.cpp lists the commands.
#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace bendlab {

/// The least and the largest value of an option.
struct Range {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
};
constexpr Range any_number{}, not_negative{.least = 0}, positive{.least = std::numeric_limits<double>::min()};

/// A variable for the value of an option. A bool makes the option a flag; a vector takes one or more values.
using OptionVariable = std::variant<bool*, int*, double*, std::optional<double>*, std::string*,
                                    std::filesystem::path*, std::vector<int>*, std::vector<std::string>*>;

struct Option {
  std::string name;  ///< "--jobs,-j"; without dashes, "CONFIG", the name of a positional argument
  std::string type;  ///< what --help writes for the value; empty: TEXT, INT or FLOAT
  std::vector<std::string> choices{};  ///< empty: any value
  bool required = false, separate = false, by_commas = false;
  OptionVariable variable;
  std::string meaning;
  Range range;

  /// `usage` is the name and the value: "CONFIG", "[CONFIG]" if it may be left out, "--out,-o FILE",
  /// "--format! FILE" if it is required, "--shell bash|zsh" with the choices, "--set VALUE..." if each value
  /// needs an own --set, "--models NAME,..." if the values are separated by commas.
  Option(std::string_view usage, OptionVariable variable, std::string meaning, const Range& range);
};

struct Command {
  std::vector<Option> option_list;
  std::string more;             ///< further text for --help
  bool takes_anything = false;  ///< arguments that are not in `option_list` are allowed
  bool json = false;            ///< --json of most commands

  Command() = default;
  Command(const Command&) = delete;  // the options point to variables of the command
  Command& operator=(const Command&) = delete;
  virtual ~Command() = default;

  /// Returns the exit code, or throws (see errors.hpp).
  virtual int run() = 0;

  /// --help shows the variable's initial value as the default, unless this value is empty or 0.
  template <class Value>
  void add(Value& variable, std::string_view usage, std::string meaning, const Range& range = any_number) {
    option_list.emplace_back(usage, &variable, std::move(meaning), range);
  }
};

struct CommandKind {
  std::string_view name, summary;
  std::string_view example;  ///< a complete command for a checkout with results; empty: --help hides it
  std::unique_ptr<Command> (*make)();
};

template <class Kind>
std::unique_ptr<Command> make() {
  return std::make_unique<Kind>();
}

/// All commands, in the order of --help.
std::span<const CommandKind* const> commands();

/// Parses the arguments, runs the command that they name, and returns its exit code. Prints the help, or what
/// is wrong with the arguments. Throws what the command throws.
int parsed_command(int argc, char** argv);

}  // namespace bendlab
