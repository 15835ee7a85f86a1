// Commands that are not for users: `read-file`, which checked_read.hpp runs in a separate process, and
// `test`, which the start script replaces.
#include "experiments/cli/command.hpp"
#include "experiments/run/checked_read.hpp"
#include "experiments/run/errors.hpp"

namespace bendlab {
namespace {

struct ReadFileCommand : Command {
  std::string file;

  ReadFileCommand() { add(file, "FILE", "The run file"); }
  int run() override { return print_record(file); }
};

struct TestCommand : Command {
  TestCommand() { takes_anything = true; }
  int run() override {
    throw UsageError(
        "only the start script in the checkout builds and runs the tests: ./bendlab test [--all | ctest "
        "arguments]");
  }
};

}  // namespace

extern const CommandKind read_file_command{"read-file", "Print the record of a run file", "",
                                           make<ReadFileCommand>};
extern const CommandKind test_command{"test", "Build and run the tests (./bendlab test)",
                                      "./bendlab test -R config", make<TestCommand>};

}  // namespace bendlab
