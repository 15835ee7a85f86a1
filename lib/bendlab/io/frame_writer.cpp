#include "bendlab/io/frame_writer.hpp"

#include <ctime>
#include <utility>

namespace bendlab {
namespace {

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

FrameWriter::FrameWriter(const std::filesystem::path& path, const RunHeader& header,
                         std::function<void(Frame&)> prepare, const std::filesystem::path& part,
                         const EarlierFrames& earlier, const InMemory& first)
    : writer_(path, header, part, earlier, first), prepare_(std::move(prepare)), thread_([this] { run(); }) {}

FrameWriter::~FrameWriter() {
  stop();
}

void FrameWriter::push(Frame frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failure_ || queue_.size() < capacity; });
  rethrow_failure();
  queue_.push_back(std::move(frame));
  changed_.notify_all();
}

void FrameWriter::drain() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failure_ || (queue_.empty() && !busy_); });
  rethrow_failure();
}

void FrameWriter::synchronise() {
  drain();
  writer_.synchronise();
}

void FrameWriter::finish(const RunFooter& footer) {
  const bool already_reported = [&] {
    const std::scoped_lock lock(mutex_);
    return reported_;
  }();
  if (!already_reported) drain();
  stop();
  writer_.finish(footer);
}

std::uint64_t FrameWriter::frames() const {
  const std::scoped_lock lock(mutex_);
  return frames_;
}

double FrameWriter::cpu_s() const {
  const std::scoped_lock lock(mutex_);
  return cpu_s_;
}

void FrameWriter::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return stopping_ || !queue_.empty(); });
    if (queue_.empty()) return;
    Frame frame = std::move(queue_.front());
    queue_.pop_front();
    busy_ = true;
    changed_.notify_all();
    lock.unlock();
    std::exception_ptr failure;
    try {
      if (prepare_) prepare_(frame);
      writer_.write(frame);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    busy_ = false;
    cpu_s_ = thread_cpu_s();
    failure_ = failure;
    if (!failure) ++frames_;
    changed_.notify_all();
    if (failure) return;
  }
}

void FrameWriter::rethrow_failure() {
  if (!failure_) return;
  reported_ = true;
  std::rethrow_exception(failure_);
}

void FrameWriter::stop() {
  {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

}  // namespace bendlab
