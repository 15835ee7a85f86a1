// Writes the files of an export as drafts in a temporary folder. At the end, every file is moved to its own
// name. So every file appears whole, and no file appears if the export fails or is stopped.
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

/// Thrown when the export is to stop. The drafts are removed.
struct ExportStopped {};

/// A file that is written from front to back. Every function throws RunFileError if the disk fails.
class OutputFile {
 public:
  /// Makes the file `draft`. Errors name the file `name`.
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
  /// Writes the bytes of a number as in memory.
  template <class Number>
  void write_number(Number number) {
    static_assert(std::endian::native == std::endian::little, "the binary formats are little endian");
    write({reinterpret_cast<const char*>(&number), sizeof number});
  }

  /// Must be called after the last write. Returns the number of bytes.
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
    std::filesystem::path to;                 ///< a folder, or a file with the extension of the format
    std::string_view extension;               ///< of the format, without its dot
    bool force = false;                       ///< replace existing files
    const std::atomic<bool>* stop = nullptr;  ///< true: stop; null: cannot be stopped
  };

  /// Throws UsageError if a file exists that only `force` would replace, RunFileError if the folder cannot be
  /// made.
  explicit Output(const Options& options);
  ~Output();  ///< removes drafts that publish() did not name
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// Whether `to` names a file (of the cloth) instead of a folder.
  bool is_file() const { return is_file_; }

  /// Writes the file `name` by calling `write(OutputFile&)`. Throws RunFileError, ExportStopped.
  template <class Write>
  void file(const std::string& name, const Write& write) {
    OutputFile file(draft(name), folder_ / name, options_.stop);
    write(file);
    bytes_ += file.finish();
  }

  /// The name of a surface's file, without extension.
  std::string stem_of(const Surface& surface) const;

  /// The name of the file of one frame: "cloth.0012". If `to` names a file, there is only one frame, and the
  /// name has no number.
  std::string stem_of(const Surface& surface, std::int64_t frame);

  /// Gives all files their names. With `force`, also removes frames of an earlier export that this export
  /// does not have. Throws RunFileError; UsageError if another program has made a file of the same name
  /// meanwhile.
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
  std::set<std::string> names_, sequences_;          // of files; the stems of numbered files
  std::uint64_t bytes_ = 0;
};

}  // namespace bendlab
