// The commands of the program, their options and help texts.
#pragma once

namespace bendlab {

/// Parses the arguments, runs the command that they name, and returns its exit code. Prints the help, or what
/// is wrong with the arguments. Throws what the command throws.
int parsed_command(int argc, char** argv);

}  // namespace bendlab
