#include "experiments/cli/command_line.hpp"

int main(int argc, char** argv) {
  bendlab::leave(bendlab::command_line(argc, argv));
}
