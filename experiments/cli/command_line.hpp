// The command line: parses arguments, runs the command, turns errors into messages and exit codes.
#pragma once

namespace bendlab {

/// Data goes to stdout, messages to stderr. Returns the exit code (see exit_codes.hpp); throws nothing.
int command_line(int argc, char** argv);

}  // namespace bendlab
