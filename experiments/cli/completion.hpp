// Completion of the command line for shells.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace bendlab {

/// A script for `shell`, bash or zsh, that completes commands, options, pointers of settings, and file names.
/// The shell reads the script by: source <(bendlab completion bash).
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace bendlab
