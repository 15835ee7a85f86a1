// Other programs that a command starts.
#pragma once

#include <string>
#include <vector>

namespace bendlab {

/// Runs a program to its end, with the standard streams of this process. `arguments`: the program's path,
/// then its arguments. Returns the program's exit code, 128 + the signal that ended the program, or 127 if
/// the start failed.
int run_program(std::vector<std::string> arguments);

/// The path of the program that is running.
std::string own_program();

/// The text as one word for a shell, in single quotes if it needs quotes.
std::string shell_quoted(const std::string& text);

}  // namespace bendlab
