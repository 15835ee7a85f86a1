#include "experiments/cli/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "experiments/cli/commands.hpp"
#include "experiments/config/settings_by_pointer.hpp"

namespace bendlab {
namespace {

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> options;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  return options;
}

// The pointers of all settings, except the settings of effects.
std::vector<std::string> pointers() {
  std::vector<std::string> pointers;
  for (const std::string& pointer : known_pointers(Json::object()))
    if (!pointer.starts_with("/effects/")) pointers.push_back(pointer + "=");
  return pointers;
}

}  // namespace

std::string completion_script(const CLI::App& app, const std::string& shell) {
  std::vector<std::string> names;
  std::string cases;
  for (const CLI::App* command :
       app.get_subcommands([](const CLI::App* c) { return !c->get_group().empty(); })) {
    names.push_back(command->get_name());
    cases +=
        fmt::format("    {}) options='{}' ;;\n", command->get_name(), fmt::join(options_of(*command), " "));
  }
  std::vector<std::string> formats;
  for (const auto& [format, summary] : export_formats()) formats.push_back(format);
  const std::string script =
      fmt::format(R"(_bendlab() {{
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
    --format)
      COMPREPLY=($(compgen -W '{}' -- "$word"))
      return ;;
  esac
  case ${{COMP_WORDS[1]}} in
{}  esac
  case $word in
    -*) COMPREPLY=($(compgen -W "$options" -- "$word")) ;;
    *) COMPREPLY=($(compgen -f -- "$word")) ;;
  esac
}}
complete -o filenames -F _bendlab bendlab ./bendlab
)",
                  fmt::join(names, " "), fmt::join(pointers(), " "), fmt::join(formats, " "), cases);
  return shell == "zsh" ? "autoload -Uz bashcompinit && bashcompinit\n" + script : script;
}

}  // namespace bendlab
