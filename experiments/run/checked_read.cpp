#include "experiments/run/checked_read.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "bendlab/io/checksum.hpp"
#include "bendlab/io/disk.hpp"
#include "bendlab/io/facts.hpp"
#include "bendlab/io/folder_lock.hpp"

extern char** environ;

namespace bendlab {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr auto time_limit = std::chrono::seconds(10);
constexpr rlim_t memory_limit = rlim_t{4} << 30;  // bytes

std::atomic<bool> has_child{false};  // the program answers `read-file FILE`

// The output that a child process wrote before it ended or was killed.
struct Answer {
  std::string text;
  int status = 0;
  bool late = false;
};

class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) throw RunFileError("no pipe can be made: too many open files");
  }
  ~Pipe() {
    for (const int end : ends_)
      if (end >= 0) ::close(end);
  }
  int out() const { return ends_[0]; }
  int in() const { return ends_[1]; }
  void close_in() { ::close(std::exchange(ends_[1], -1)); }

 private:
  std::array<int, 2> ends_{-1, -1};
};

Answer ask_child(const fs::path& file) {
  Pipe pipe;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe.in(), STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string program = "/proc/self/exe", command = "read-file", path = fs::absolute(file).string();
  std::array<char*, 4> arguments = {program.data(), command.data(), path.data(), nullptr};
  pid_t child = 0;
  const int failed = ::posix_spawn(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw file_error(file, "can't be read", std::system_category().message(failed), failed);
  pipe.close_in();
  Answer answer;
  const Clock::time_point end = Clock::now() + time_limit;
  std::array<char, 1 << 16> block{};
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd readable{pipe.out(), POLLIN, 0};
    if (left <= 0 || ::poll(&readable, 1, static_cast<int>(left)) == 0) {
      answer.late = true;
      ::kill(child, SIGKILL);
      break;
    }
    const ssize_t got = ::read(pipe.out(), block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    answer.text.append(block.data(), static_cast<std::size_t>(got));
  }
  while (::waitpid(child, &answer.status, 0) < 0 && errno == EINTR) {
  }
  return answer;
}

RunRecord read_by_child(const fs::path& file) {
  const Answer answer = ask_child(file);
  const auto fail = [&](const std::string& why) {
    throw file_error(file, "can't be read as a run file", why, 0);
  };
  if (answer.late) fail(fmt::format("the HDF5 library has not read it within {} s", time_limit.count()));
  if (WIFSIGNALED(answer.status))
    fail(fmt::format("the HDF5 library crashes on it ({})", ::strsignal(WTERMSIG(answer.status))));
  const Json json = Json::parse(answer.text, nullptr, false);
  if (json.is_discarded()) fail("it is damaged");
  if (json.contains("error")) throw RunFileError(json["error"].get<std::string>());
  return record_of(json, file);
}

}  // namespace

RunRecord read_checked(const fs::path& file) {
  const Seal seal = seal_of(file);
  if (seal == Seal::broken)
    throw file_error(file, "can't be used",
                     "the file was changed after it was written: its checksum is wrong", 0);
  if (seal == Seal::whole) return read_run(file);
  RunRecord run = has_child ? read_by_child(file) : read_run(file);
  if (is_over(run.status))
    throw file_error(file, "can't be used",
                     "the file was changed after it was written: it is finished, but has no checksum", 0);
  if (run.status == RunStatus::running && !is_locked(file.parent_path())) run.status = RunStatus::interrupted;
  return run;
}

void answers_read_file() {
  has_child = true;
}

int print_record(const fs::path& file) {
#ifndef __SANITIZE_ADDRESS__  // the address sanitizer reserves terabytes of addresses
  const rlimit memory{memory_limit, memory_limit};
  ::setrlimit(RLIMIT_AS, &memory);
#endif
  Json json;
  try {
    json = facts_of(read_run(file));
  } catch (const std::exception& error) {
    json = {{"error", error.what()}};
  }
  fmt::print("{}\n", json.dump(-1, ' ', false, Json::error_handler_t::replace));
  return 0;
}

}  // namespace bendlab
