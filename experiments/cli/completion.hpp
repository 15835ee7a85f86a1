// Completion of the command line for shells.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace bendlab {

/// A script for `shell`, bash or zsh, that completes the commands of the app, their options, the pointers of
/// settings, and files. To be read by the shell: source <(bendlab completion bash).
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace bendlab
