#include "experiments/cli/command_line.hpp"

int main(int argc, char** argv) {
  return bendlab::command_line(argc, argv);
}
