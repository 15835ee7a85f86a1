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
  static constexpr std::size_t capacity = 4;  ///< frames: enough to bridge a slow write, few enough to keep

  /// The writer thread calls `prepare` before it writes a frame, for one frame after another. `prepare`
  /// computes metrics and cell fields from time and positions. The caller may use data that `prepare` uses
  /// only after drain(). Throws RunFileError if the file can't be created.
  FrameWriter(const std::filesystem::path& path, const RunHeader& header,
              std::function<void(Frame&)> prepare = {}, const std::filesystem::path& part = {},
              const EarlierFrames& earlier = {}, const InMemory& first = {});

  /// Writes the queued frames and closes the file. Without finish() the file keeps its suffix .part.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Puts a frame into the queue; waits while the queue is full. If an exception has stopped the thread (a
  /// RunFileError, or from `prepare`), throws this exception. All earlier frames are in the file.
  void push(Frame frame);

  /// Waits until all frames of the queue are in the file. Throws the same exceptions as push().
  void drain();

  /// Calls drain(), and waits until all written frames are on the disk.
  void synchronise();

  /// Calls drain(), then RunFileWriter::finish(). If push() or drain() has already thrown an exception of
  /// `prepare`, the file has the frames before the exception.
  void finish(const RunFooter& footer);

  std::uint64_t frames() const;  ///< written so far
  double cpu_s() const;          ///< processor time of the writer thread so far, s; complete after drain()

 private:
  void run();
  void rethrow_failure();
  void stop();

  RunFileWriter writer_;
  std::function<void(Frame&)> prepare_;

  mutable std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::deque<Frame> queue_;
  bool busy_ = false, stopping_ = false, reported_ = false;
  std::exception_ptr failure_;
  std::uint64_t frames_ = 0;
  double cpu_s_ = 0;

  std::thread thread_;  // last, because the thread uses all members above
};

}  // namespace bendlab
