// After a kill or on a full disk, a run keeps every frame whose write() returned.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <thread>

#include "bendlab/io/run_file.hpp"
#include "tests/catch.hpp"
#include "tests/io/run_fixture.hpp"

namespace bendlab::run_file_crash_test {
using namespace bendlab::test;
namespace fs = std::filesystem;

namespace {

/// A child process with a pipe to its parent.
struct Child {
  pid_t pid = -1;
  int output = -1;  ///< the read end of the pipe
};

/// Runs `work` in a child process. It gets the write end of the pipe, and never returns to the test program.
template <class Work>
Child fork_child(const Work& work) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
  const pid_t pid = fork();
  if (pid == 0) {
    try {
      work(ends[1]);
    } catch (...) {
      _exit(2);
    }
    _exit(0);
  }
  close(ends[1]);
  return {pid, ends[0]};
}

/// Everything in the pipe, until the child ends.
std::string read_all(const Child& child) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t n; (n = read(child.output, buffer.data(), buffer.size())) > 0;)
    text.append(buffer.data(), static_cast<std::size_t>(n));
  close(child.output);
  return text;
}

/// During its lifetime, the system's folder for temporary files is this folder.
class TemporaryFilesIn {
 public:
  explicit TemporaryFilesIn(const fs::path& folder) {
    if (const char* const usual = std::getenv("TMPDIR")) usual_ = usual;
    setenv("TMPDIR", folder.c_str(), 1);
  }
  TemporaryFilesIn(const TemporaryFilesIn&) = delete;
  TemporaryFilesIn& operator=(const TemporaryFilesIn&) = delete;
  ~TemporaryFilesIn() { usual_ ? setenv("TMPDIR", usual_->c_str(), 1) : unsetenv("TMPDIR"); }

 private:
  std::optional<std::string> usual_;
};

void acknowledge(int pipe_end) {
  if (write(pipe_end, "+", 1) != 1) _exit(3);
}

}  // namespace

TEST_CASE("run file: kill -9 at any moment keeps every written frame", "[io]") {
  constexpr int kills = 20;
  std::mt19937 random(1);
  std::uniform_int_distribution<int> delay_us(0, 10000);
  for (int i = 0; i < kills; ++i) {
    const TemporaryFolder folder;
    const auto path = folder / "run.vtkhdf", part = folder / "run.vtkhdf.part";
    const Child child = fork_child([&](int acknowledged) {
      RunFileWriter writer(path, square_header());
      for (int k = 0;; ++k) {
        writer.write(square_frame(k));
        acknowledge(acknowledged);
      }
    });
    char first = 0;
    REQUIRE(read(child.output, &first, 1) == 1);  // the run has started
    std::this_thread::sleep_for(std::chrono::microseconds(delay_us(random)));
    kill(child.pid, SIGKILL);
    int status = 0;
    REQUIRE(waitpid(child.pid, &status, 0) == child.pid);
    REQUIRE(WIFSIGNALED(status));
    const std::size_t acknowledged = 1 + read_all(child).size();

    const RunRecord run = read_run(part);
    CHECK(run.status == RunStatus::running);
    CHECK(run.frames >= acknowledged);
    CHECK(run.frames <= acknowledged + 1);
    CHECK(wrong_frames(part) == 0);
    CHECK(goes_on_from(part, path, run.frames));
    CHECK(wrong_frames(path) == 0);
    if (i > 0) continue;  // starting Python would take most of the time
    CHECK(h5py_accepts(path, R"(
steps, frames = run['VTKHDF/Steps'], run['metrics/values'].shape[0]
assert steps.attrs['NSteps'] == frames == len(steps['CellDataOffsets/shape'])
assert len(steps['PointDataOffsets/pinned']) == frames
assert all(len(steps[name]) == frames for name in steps if isinstance(steps[name], h5py.Dataset))
assert run['VTKHDF/Points'].shape == (4 * frames, 3) and run['VTKHDF/CellData/stretch'].shape == (2 * frames,)
assert run['metrics/values'][-1, 0] == 0.25 * (frames - 1)
assert json.loads(run['outcome'][()].tobytes())['status'] == 'interrupted'
)"));
  }
}

TEST_CASE("run file: frames beyond the end that a killed flush recorded are read", "[io]") {
  const TemporaryFolder folder;
  const auto path = folder / "run.vtkhdf", part = folder / "run.vtkhdf.part", killed = folder / "killed.part";
  const auto bytes = [](const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  RunFileWriter writer(path, square_header());
  constexpr int earlier = 3, frames = 200;
  constexpr std::size_t superblock = 48;  // bytes: version 2, which states the end of the file
  for (int k = 0; k < earlier; ++k) writer.write(square_frame(k));
  const std::string before = bytes(part).substr(0, superblock);
  for (int k = earlier; k < frames; ++k) writer.write(square_frame(k));
  const std::string after = bytes(part);
  REQUIRE(before != after.substr(0, superblock));
  std::ofstream(killed, std::ios::binary) << before << after.substr(superblock);
  // The file is read from a temporary copy, which is removed. Reading needs no write permission.
  {
    const TemporaryFilesIn here(folder / "temporary");
    fs::create_directory(folder / "temporary");
    fs::permissions(killed, fs::perms::owner_read);
    CHECK(read_run(killed).frames == frames);
    CHECK(wrong_frames(killed) == 0);
    CHECK(fs::is_empty(folder / "temporary"));
  }
  {
    const TemporaryFilesIn nowhere(folder / "missing");
    CHECK_THAT(error_text<RunFileError>([&] { read_run(killed); }),
               Catch::Matchers::ContainsSubstring("TMPDIR") && Catch::Matchers::ContainsSubstring("missing"));
  }
  const std::string left = bytes(killed);
  CHECK(left == before + after.substr(superblock));  // reading changes nothing
  CHECK(goes_on_from(killed, folder / "other.vtkhdf", frames));
}

TEST_CASE("run file: an end that a killed process only started to write does not count", "[io]") {
  const TemporaryFolder folder;
  const auto path = folder / "run.vtkhdf", part = folder / "run.vtkhdf.part";
  {
    RunFileWriter writer(path, square_header());
    for (int k = 0; k < 5; ++k) writer.write(square_frame(k));
  }
  REQUIRE(h5py_accepts(part, R"(
run.close()
with h5py.File(sys.argv[1], 'r+') as file:
    file['outcome'] = np.zeros(100, 'u1')
)"));
  CHECK(read_run(part).status == RunStatus::running);
  CHECK(read_run(part).frames == 5);
  CHECK(goes_on_from(part, path, 5));
}

TEST_CASE("run file: a full disk is an error that keeps the frames before it", "[io][slow]") {
  // A limit on the file size replaces a full disk: writes beyond the limit fail in the same way. The limits
  // are spread over the growth of several frames.
  for (rlim_t limit = 180000; limit < 210000; limit += 3777) {
    CAPTURE(limit);
    const TemporaryFolder folder;
    const auto path = folder / "run.vtkhdf", part = folder / "run.vtkhdf.part";
    const Child child = fork_child([&](int output) {
      const rlimit size{limit, limit};
      signal(SIGXFSZ, SIG_IGN);  // then write() fails with EFBIG instead
      if (setrlimit(RLIMIT_FSIZE, &size) != 0) _exit(3);
      RunFileWriter writer(path, square_header());
      const std::string text = error_text<RunFileError>([&] {
        for (int k = 0;; ++k) {
          writer.write(square_frame(k));
          acknowledge(output);
        }
      });
      const std::string again = error_text<RunFileError>([&] { writer.finish({}); });
      const bool reported = text.find("File too large") != std::string::npos &&
                            again.find("an earlier write failed") != std::string::npos;
      if (!reported) _exit(4);
    });
    int status = 0;
    const std::size_t written = read_all(child).size();
    REQUIRE(waitpid(child.pid, &status, 0) == child.pid);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    CHECK(written > 0);
    CHECK(read_run(part).frames == written);
    CHECK(wrong_frames(part) == 0);
    CHECK(goes_on_from(part, path, written));
    CHECK(wrong_frames(path) == 0);
  }
}

TEST_CASE("run file: a run continues only if there is room for all its earlier frames", "[io]") {
  constexpr int frames = 20;
  const TemporaryFolder folder;
  const auto path = folder / "run.vtkhdf", part = folder / "run.vtkhdf.part";
  {
    RunFileWriter writer(path, square_header());
    for (int k = 0; k < frames; ++k) writer.write(square_frame(k));
  }
  REQUIRE(read_run(part).frames == frames);
  // The disk is full now. A frame may take 64 KB with the indices of its four datasets, so 1 MB has room for
  // one frame but perhaps not for 20. The error comes before the first frame is copied.
  const Child child = fork_child([&](int) {
    const rlimit size{1 << 20, 1 << 20};
    signal(SIGXFSZ, SIG_IGN);
    if (setrlimit(RLIMIT_FSIZE, &size) != 0) _exit(3);
    const std::string text = error_text<RunFileError>([&] {
      RunFileWriter(path, square_header(), path.string() + ".new.part", {part, frames});
    });
    if (text.find("can't begin") == std::string::npos) _exit(4);
  });
  read_all(child);
  int status = 0;
  REQUIRE(waitpid(child.pid, &status, 0) == child.pid);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  CHECK(wrong_frames(part) == 0);
  CHECK(goes_on_from(part, path, frames));
}

}  // namespace bendlab::run_file_crash_test
