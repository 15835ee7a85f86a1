// `bendlab completion`: a script for a shell, which completes commands, options, their values, pointers of
// settings, and file names.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/cli/command.hpp"
#include "experiments/config/settings_by_pointer.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"

namespace bendlab {
namespace {

// The pointers of all settings, except the settings of effects.
std::vector<std::string> pointers() {
  std::vector<std::string> pointers;
  for (const std::string& pointer : known_pointers(Json::object()))
    if (!pointer.starts_with("/effects/")) pointers.push_back(pointer + "=");
  return pointers;
}

struct CompletionCommand : Command {
  std::string shell;

  CompletionCommand() {
    add(shell, "SHELL bash|zsh", "The shell, in which to type: source <(bendlab completion bash)");
  }

  int run() override {
    std::vector<std::string_view> names;
    std::string options_of, choices_of;  // cases of the script
    for (const CommandKind* kind : commands()) {
      if (kind->example.empty()) continue;
      names.push_back(kind->name);
      options_of += fmt::format("    {}) options='--help", kind->name);
      const std::unique_ptr<Command> command = kind->make();
      for (const Option& option : command->option_list) {
        if (!option.name.starts_with('-')) continue;
        const std::string name = option.name.substr(0, option.name.find(','));
        options_of += " " + name;
        if (!option.choices.empty())
          choices_of += fmt::format("    '{} {}') COMPREPLY=($(compgen -W '{}' -- \"$word\")); return ;;\n",
                                    kind->name, name, fmt::join(option.choices, " "));
      }
      options_of += "' ;;\n";
    }
    if (shell == "zsh") print_text("autoload -Uz bashcompinit && bashcompinit\n");
    print_text(R"(_bendlab() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} options=
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W '{}' -- "$word"))
    return
  fi
  case $before in
    --set | --sweep | --where)
      COMPREPLY=($(compgen -W '{}' -- "$word"))
      compopt -o nospace 2>/dev/null
      return ;;
  esac
  case "${{COMP_WORDS[1]}} $before" in
{}  esac
  case ${{COMP_WORDS[1]}} in
{}  esac
  case $word in
    -*) COMPREPLY=($(compgen -W "$options" -- "$word")) ;;
    *) COMPREPLY=($(compgen -f -- "$word")) ;;
  esac
}}
complete -o filenames -F _bendlab bendlab ./bendlab
)",
               fmt::join(names, " "), fmt::join(pointers(), " "), choices_of, options_of);
    return exit_ok;
  }
};

}  // namespace

extern const CommandKind completion_command{"completion",
                                            "Print a script that completes the command line in a shell",
                                            "source <(bendlab completion bash)", make<CompletionCommand>};

}  // namespace bendlab
