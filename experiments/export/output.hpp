// Where an export goes. Files are written as drafts, in a folder of their own, and get their names at the
// end: each appears whole, and none does if the export fails or is stopped.
#pragma once

#include <fmt/format.h>

#include <atomic>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bendlab {

struct Surface;

/// Thrown when somebody asked to stop: the drafts are gone.
struct ExportStopped {};

/// A file that is written from front to back. Every function throws RunFileError if the disk fails.
class OutputFile {
 public:
  /// Makes the file at `draft`; `name` is what errors call it.
  OutputFile(const std::filesystem::path& draft, std::filesystem::path name, const std::atomic<bool>* stop);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes) {
    buffer_.append(bytes.data(), bytes.data() + bytes.size());
    flush_if_full();
  }
  template <class... Args>
  void print(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Args>(args)...);
    flush_if_full();
  }
  /// A number as it lies in memory.
  template <class Number>
  void write_number(Number number) {
    static_assert(std::endian::native == std::endian::little, "the binary formats are little endian");
    write({reinterpret_cast<const char*>(&number), sizeof number});
  }

  /// To be called when all is written. Returns the number of bytes.
  std::uint64_t finish();

 private:
  void flush_if_full() {
    if (buffer_.size() >= full) flush();
  }
  void flush();

  static constexpr std::size_t full = std::size_t{1} << 20;  // bytes
  std::filesystem::path name_;
  const std::atomic<bool>* stop_;
  int descriptor_;
  std::uint64_t bytes_ = 0;
  fmt::memory_buffer buffer_;
};

class Output {
 public:
  struct Options {
    std::filesystem::path to;                 ///< a folder, or the file whose extension is the format's
    std::string_view extension;               ///< of the format, without its dot
    bool force = false;                       ///< replace what is there
    const std::atomic<bool>* stop = nullptr;  ///< null: nobody stops it
  };

  /// Throws UsageError if there is something that `force` would replace, RunFileError if the folder cannot be
  /// made.
  explicit Output(const Options& options);
  ~Output();  ///< removes what publish() did not name
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// Whether `to` names a file: the name of the cloth's is known then.
  bool is_file() const { return is_file_; }

  /// Writes a file of this name by `write(OutputFile&)`. Throws RunFileError, ExportStopped.
  template <class Write>
  void file(const std::string& name, const Write& write) {
    OutputFile file(draft(name), folder_ / name, options_.stop);
    write(file);
    bytes_ += file.finish();
  }

  /// The name of a surface's file, without extension.
  std::string stem_of(const Surface& surface) const;

  /// The same of one of its frames: "cloth.0012". In a file that `to` names there is one frame only.
  std::string stem_of(const Surface& surface, std::int64_t frame);

  /// Gives all files their names; with `force` also removes the frames of an earlier export that this one
  /// does not have. Throws RunFileError; UsageError if a file of that name came in between.
  void publish();

  const std::filesystem::path& to() const { return options_.to; }
  std::size_t file_count() const { return names_.size(); }
  std::uint64_t bytes() const { return bytes_; }

 private:
  std::filesystem::path draft(const std::string& name);
  void make_folder();
  void remove_old_frames() const;

  Options options_;
  bool is_file_ = false, published_ = false;
  std::filesystem::path folder_, drafts_;
  std::vector<std::filesystem::path> made_folders_;  // the deepest first
  std::set<std::string> names_, sequences_;          // of files; the stems of those that are numbered
  std::uint64_t bytes_ = 0;
};

}  // namespace bendlab
