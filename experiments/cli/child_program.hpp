// Other programs that a command starts.
#pragma once

#include <string>
#include <vector>

namespace bendlab {

/// Runs a program (its path and its arguments) to its end, with this one's streams. Returns its exit code,
/// 128 + the signal that ended it, or 127 if it can't be started.
int run_program(std::vector<std::string> arguments);

/// The file of the program that is running.
std::string own_program();

/// The text as a shell takes it, in single quotes if it needs some.
std::string shell_quoted(const std::string& text);

}  // namespace bendlab
