// Another thread writes frames to the file in order, and a failure there reaches the caller.
#include "bendlab/io/frame_writer.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <thread>

#include "tests/catch.hpp"
#include "tests/io/run_fixture.hpp"

namespace bendlab::frame_writer_test {
using namespace bendlab::test;
namespace fs = std::filesystem;

namespace {

/// Time and positions of frame k. `fill` adds metrics and cell fields.
Frame bare_frame(int k) {
  Frame frame = square_frame(k);
  frame.metrics.clear();
  frame.cell_fields.clear();
  return frame;
}

void fill(Frame& frame) {
  const Frame whole = square_frame(static_cast<int>(frame.positions[2]));
  frame.metrics = whole.metrics;
  frame.cell_fields = whole.cell_fields;
}

}  // namespace

TEST_CASE("frame writer: frames are prepared and written in order", "[io]") {
  const TemporaryFolder folder;
  const auto path = folder / "run.vtkhdf";
  std::thread::id worker;
  FrameWriter writer(path, square_header(), [&](Frame& frame) {
    worker = std::this_thread::get_id();
    fill(frame);
  });
  for (int k = 0; k < 50; ++k) writer.push(bare_frame(k));
  writer.drain();
  CHECK(writer.frames() == 50);
  CHECK(worker != std::this_thread::get_id());
  writer.finish(square_footer());
  CHECK(read_run(path).frames == 50);
  CHECK(read_run(path).status == RunStatus::complete);
  CHECK(wrong_frames(path) == 0);
}

TEST_CASE("frame writer: only the processor time of its thread is counted", "[io]") {
  const TemporaryFolder folder;
  using Clock = std::chrono::steady_clock;
  FrameWriter writer(folder / "run.vtkhdf", square_header(), [](Frame& frame) {
    const auto end = Clock::now() + std::chrono::milliseconds(frame.time == 0 ? 50 : 0);
    while (Clock::now() < end) continue;
    std::this_thread::sleep_for(std::chrono::milliseconds(frame.time == 0 ? 0 : 200));
  });
  const auto begin = Clock::now();
  writer.push(square_frame(0));
  writer.push(square_frame(1));
  writer.drain();
  const double wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  CHECK(writer.cpu_s() > 0);
  CHECK(writer.cpu_s() <=
        wall_s - 0.2 + 0.01);  // 200 ms of sleep do not count; clocks tick at least every 10 ms
}

TEST_CASE("frame writer: the queue is bounded", "[io]") {
  const TemporaryFolder folder;
  std::mutex mutex;
  std::condition_variable changed;
  bool open = false;
  FrameWriter writer(folder / "run.vtkhdf", square_header(), [&](Frame&) {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return open; });
  });
  // The thread holds a frame and waits. `capacity` further frames fit into the queue.
  constexpr int fit = 1 + static_cast<int>(FrameWriter::capacity);
  std::atomic<int> pushed = 0;
  std::thread solver([&] {
    for (int k = 0; k < fit + 3; ++k) {
      writer.push(square_frame(k));
      ++pushed;
    }
  });
  while (pushed < fit) std::this_thread::yield();
  std::this_thread::sleep_for(
      std::chrono::milliseconds(50));  // enough time for another push, if it were possible
  CHECK(pushed == fit);
  {
    const std::scoped_lock lock(mutex);
    open = true;
  }
  changed.notify_all();
  solver.join();
  writer.finish({});
  CHECK(read_run(folder / "run.vtkhdf").frames == fit + 3);
  CHECK(wrong_frames(folder / "run.vtkhdf") == 0);
}

TEST_CASE("frame writer: an exception of the thread reaches the caller, and earlier frames stay", "[io]") {
  const TemporaryFolder folder;
  const auto path = folder / "run.vtkhdf";
  FrameWriter writer(path, square_header(), [](Frame& frame) {
    if (frame.time == 0.75) throw std::domain_error("frame 3");
  });
  const auto push_many = [&] {
    for (int k = 0; k < 100; ++k) writer.push(square_frame(k));
  };
  CHECK(error_text<std::domain_error>(push_many) == "frame 3");
  CHECK(error_text<std::domain_error>([&] { writer.push(square_frame(0)); }) == "frame 3");
  RunFooter footer;
  footer.status = RunStatus::diverged;
  writer.finish(footer);  // the caller already knows the failure
  CHECK(read_run(path).status == RunStatus::diverged);
  CHECK(read_run(path).frames == 3);
  CHECK(wrong_frames(path) == 0);
}

TEST_CASE("frame writer: finish reports a failure that was not reported before", "[io]") {
  const TemporaryFolder folder;
  FrameWriter writer(folder / "run.vtkhdf", square_header(),
                     [](Frame&) { throw std::domain_error("frame 0"); });
  writer.push(square_frame(0));
  CHECK(error_text<std::domain_error>([&] { writer.finish({}); }) == "frame 0");
  CHECK(fs::exists(folder / "run.vtkhdf.part"));
}

TEST_CASE("frame writer: the destructor writes queued frames first", "[io]") {
  const TemporaryFolder folder;
  {
    FrameWriter writer(folder / "run.vtkhdf", square_header());
    for (int k = 0; k < 4; ++k) writer.push(square_frame(k));
  }
  CHECK(read_run(folder / "run.vtkhdf.part").frames == 4);
  CHECK(wrong_frames(folder / "run.vtkhdf.part") == 0);
}

TEST_CASE("frame writer: a missing folder is refused at once", "[io]") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(FrameWriter(folder / "absent" / "run.vtkhdf", square_header()), RunFileError);
}

}  // namespace bendlab::frame_writer_test
