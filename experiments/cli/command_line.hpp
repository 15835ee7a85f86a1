// The command line: parses arguments, runs the command, turns errors into messages and exit codes.
#pragma once

namespace bendlab {

/// Data goes to stdout, messages to stderr. Returns the exit code (see exit_codes.hpp); throws nothing.
int command_line(int argc, char** argv);

/// Ends the process without the exit handlers of libraries. After a full disk the handler of HDF5 crashes,
/// and with little memory the handler of OpenBLAS waits for threads that never existed.
[[noreturn]] void leave(int exit_code);

}  // namespace bendlab
