// All commands, and the only file that includes CLI11, because CLI11 takes long to compile.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>

#include "bendlab/scene/nearest_name.hpp"
#include "experiments/cli/command.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/version.hpp"
#include "experiments/terminal/printable.hpp"

// clang-format off
#define BENDLAB_COMMANDS(X) \
  X(run) X(plan) X(energy) X(validate) X(reproduce) \
  X(list) X(show) X(compare) X(rerun) X(export) X(report) X(view) X(stiffness) \
  X(advise) X(dialect) X(mesh) X(bench) X(models) X(effects) X(fabrics) X(fit) X(measures) X(methods) \
  X(schema) X(completion) X(read_file) X(test)
// clang-format on

namespace bendlab {

#define BENDLAB_DECLARE(name) extern const CommandKind name##_command;
BENDLAB_COMMANDS(BENDLAB_DECLARE)

std::span<const CommandKind* const> commands() {
#define BENDLAB_ADDRESS(name) &name##_command,
  static constexpr const CommandKind* all[] = {BENDLAB_COMMANDS(BENDLAB_ADDRESS)};
  return all;
}

namespace {

constexpr const char* footer =
    "Exit codes: 0 success; 1 a run or an expectation failed, or a run is implausible; 2 wrong usage;\n3 "
    "error in a config; 4 error in a mesh; 5 a file cannot be read or written; 6 a run diverged;\n130 and "
    "143 stopped by a signal.\nThe first Ctrl-C stops after the current frame, which is kept; the second "
    "Ctrl-C stops at once.\nData goes to stdout, messages to stderr. NO_COLOR=1 turns colours off.";

CLI::Option* add_variable(CLI::App& app, const Option& option) {
  return std::visit(
      [&](auto* variable) -> CLI::Option* {
        using Value = std::remove_pointer_t<decltype(variable)>;
        if constexpr (std::is_same_v<Value, bool>) {
          return app.add_flag(option.name, *variable, option.meaning);
        } else {
          CLI::Option* added = app.add_option(option.name, *variable, option.meaning);
          if (*variable != Value{}) added->capture_default_str();
          return added;
        }
      },
      option.variable);
}

void add_option(CLI::App& app, const Option& option) {
  CLI::Option* added = add_variable(app, option);
  added->required(option.required);
  if (!option.type.empty()) added->type_name(option.type);
  if (!option.choices.empty()) added->check(CLI::IsMember(option.choices));
  if (option.separate) added->allow_extra_args(false);
  if (option.by_commas) added->delimiter(',');
  const auto [least, most] = option.range;
  if (least > 0 && std::isinf(most)) added->check(CLI::PositiveNumber);
  if (least == 0 && std::isinf(most)) added->check(CLI::NonNegativeNumber);
  if (std::isinf(most)) return;
  if (std::holds_alternative<double*>(option.variable))
    added->check(CLI::Range(least, most));
  else
    added->check(CLI::Range(static_cast<int>(least), static_cast<int>(most)));
}

void add_command(CLI::App& program, const CommandKind& kind, Command& command) {
  CLI::App& app = *program.add_subcommand(std::string(kind.name), std::string(kind.summary));
  for (const Option& option : command.option_list) add_option(app, option);
  app.allow_extras(command.takes_anything);
  if (kind.example.empty())
    app.group("");  // --help hides it
  else
    app.footer(fmt::format("{}Example: {}", command.more, kind.example));
}

/// Prints CLI11's message; for an unknown command, the command that was probably meant.
int usage_error(const CLI::ParseError& error, int argc, char** argv) {
  if (argc > 1 && argv[1][0] != '-') {
    std::vector<std::string_view> names;
    for (const CommandKind* kind : commands())
      if (!kind->example.empty()) names.push_back(kind->name);
    if (std::ranges::find(names, argv[1]) == names.end()) {
      print_text(stderr, "bendlab: there is no command '{}'{}\nCommands: {}\n", argv[1],
                 suggestion(argv[1], names), fmt::join(names, ", "));
      return exit_usage;
    }
  }
  print_text(stderr, "bendlab: {}\nRun with --help for the usage.\n", error.what());
  return exit_usage;
}

}  // namespace

int parsed_command(int argc, char** argv) {
  CLI::App program("Bending models for strain-based cloth simulation, compared by experiment.", "bendlab");
  program.footer(footer);
  program.set_version_flag("--version", std::string(version_text()));
  program.require_subcommand(1);
  std::map<std::string_view, std::unique_ptr<Command>> made;
  for (const CommandKind* kind : commands()) add_command(program, *kind, *(made[kind->name] = kind->make()));
  if (argc == 1) {
    print_text(stderr, "{}", program.help());
    return exit_usage;
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return program.exit(success);
  } catch (const CLI::ParseError& error) {
    return usage_error(error, argc, argv);
  }
  return made.at(program.get_subcommands().front()->get_name())->run();
}

}  // namespace bendlab
