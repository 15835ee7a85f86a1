// The command line: parses arguments, runs the command, turns errors into messages and exit codes.
#pragma once

namespace bendlab {

/// Data goes to stdout, messages to stderr. Returns the exit code (see exit_codes.hpp); throws nothing.
int command_line(int argc, char** argv);

/// Ends the process without what libraries do at its end: after a full disk that of HDF5 crashes, and with
/// little memory that of OpenBLAS waits for threads which it never had.
[[noreturn]] void leave(int exit_code);

}  // namespace bendlab
