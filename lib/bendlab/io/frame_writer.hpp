// Writes the frames of a run on its own thread, so that the solver does not wait for metrics or the disk.
//
//   solver ── push(frame) ──▶ [ at most 4 frames ] ──▶ prepare(frame) ──▶ RunFileWriter::write(frame)
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>

#include "bendlab/io/run_file.hpp"

namespace bendlab {

class FrameWriter {
 public:
  static constexpr std::size_t capacity = 4;  ///< frames: enough to bridge a slow write, few enough to hold

  /// `prepare` is called on the writer thread before a frame is written, one frame at a time in order: it
  /// fills metrics and cell fields from time and positions. The caller may use what it accesses only after
  /// drain(). Throws RunFileError if the file can't be created.
  FrameWriter(const std::filesystem::path& path, const RunHeader& header,
              std::function<void(Frame&)> prepare = {}, const std::filesystem::path& part = {},
              const EarlierFrames& earlier = {}, const InMemory& first = {});

  /// Writes what is queued and closes. Without finish() the .part file stays.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Hands a frame over; waits while the queue is full. Throws the exception that stopped the thread, if any:
  /// a RunFileError, or one of `prepare`. The frames before the failing one are in the file.
  void push(Frame frame);

  /// Waits until every frame pushed is in the file. Throws as push() does.
  void drain();

  /// drain(), and waits until the disk has what is in the file.
  void synchronise();

  /// drain(), then RunFileWriter::finish(). If an exception of `prepare` was already thrown, finishes the
  /// file with the frames before it.
  void finish(const RunFooter& footer);

  std::uint64_t frames() const;  ///< written so far
  double cpu_s() const;          ///< processor time of the writer thread so far, s; complete after drain()

 private:
  void run();
  void rethrow_failure();
  void stop();

  RunFileWriter writer_;
  std::function<void(Frame&)> prepare_;

  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<Frame> queue_;
  bool busy_ = false, stopping_ = false, reported_ = false;
  std::exception_ptr failure_;
  std::uint64_t frames_ = 0;
  double cpu_s_ = 0;

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace bendlab
