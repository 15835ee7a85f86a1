#include "experiments/cli/command_line.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include "experiments/cli/command.hpp"
#include "experiments/run/checked_read.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"

namespace bendlab {
namespace {

// Opens closed standard streams on /dev/null. Otherwise the next file that is opened, such as a run file,
// would get the number of the stream and receive what is printed. Then writing to a closed stdout fails, and
// writing to a closed stderr succeeds.
void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) == -1 && errno == EBADF)
      open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace

int command_line(int argc, char** argv) {
  occupy_closed_streams();
  answers_read_file();
  try {
    const int code = parsed_command(argc, argv);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    print_text(stderr, "bendlab: the output could not be written to stdout\n");
    return exit_io;
  } catch (...) {
    const Failure failure = current_failure();
    std::fputs(fmt::format("bendlab: {}\n", printable(failure.message)).c_str(),
               stderr);  // cannot throw, even on a full disk
    return failure.exit_code;
  }
}

void leave(int exit_code) {
  std::fflush(nullptr);
#ifdef __SANITIZE_ADDRESS__
  std::exit(exit_code);  // exit() looks for leaks
#else
  std::_Exit(exit_code);
#endif
}

}  // namespace bendlab
