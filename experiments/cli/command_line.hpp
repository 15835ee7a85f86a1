// The command line: runs a command, and turns errors into messages and exit codes.
#pragma once

namespace bendlab {

/// Data goes to stdout, messages to stderr. Returns the exit code (see exit_codes.hpp); throws nothing.
int command_line(int argc, char** argv);

/// Ends the process without the exit handlers of libraries. When the disk is full, the handler of HDF5
/// crashes. With little memory, the handler of OpenBLAS waits for threads that were never started.
[[noreturn]] void leave(int exit_code);

}  // namespace bendlab
