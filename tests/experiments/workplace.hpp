// Runs the program in a temporary folder, like a user would.
#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "bendlab/io/folder_lock.hpp"
#include "tests/places.hpp"

namespace bendlab::test {

inline std::string read(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A folder to run the program in, and the output of the last command.
class Workplace {
 public:
  Workplace() {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  ~Workplace() { std::filesystem::remove_all(folder); }

  /// The arguments may end with a redirection.
  int run(const std::string& arguments, const std::string& program = places::program) {
    const std::string command =
        "cd '" + folder.string() + "' && </dev/null >stdout 2>stderr '" + program + "' " + arguments;
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// Starts `bendlab run CONFIG` with an option, and sends it a signal as soon as it computes its first run.
  int run_and_signal(const std::string& config, int signal, const char* option = nullptr) {
    const pid_t child = fork();
    if (child == 0) {
      if (chdir(folder.c_str()) != 0 || !freopen("stdout", "w", stdout) || !freopen("stderr", "w", stderr))
        _exit(99);
      execl(places::program, "bendlab", "run", config.c_str(), option, static_cast<char*>(nullptr));
      _exit(98);
    }
    int status = 0;
    const auto computes = [&] {
      return std::ranges::any_of(run_files(".lock"),
                                 [](const auto& lock) { return is_locked(lock.parent_path()); });
    };
    while (!computes() && waitpid(child, &status, WNOHANG) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    kill(child, signal);
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }

  std::vector<std::filesystem::path> run_files(const std::string& extension) const {
    std::vector<std::filesystem::path> files;
    if (!std::filesystem::exists(folder / "results")) return files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             folder / "results", std::filesystem::directory_options::skip_permission_denied))
      if (entry.path().extension() == extension) files.push_back(entry.path());
    return files;
  }

  std::string out() const { return read(folder / "stdout"); }
  std::string err() const { return read(folder / "stderr"); }

  /// stdout as one JSON value per line.
  std::vector<nlohmann::json> out_lines() const {
    std::vector<nlohmann::json> lines;
    std::istringstream stream(out());
    for (std::string line; std::getline(stream, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
  }

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("bendlab command line test " + std::to_string(getpid()));
};

}  // namespace bendlab::test
