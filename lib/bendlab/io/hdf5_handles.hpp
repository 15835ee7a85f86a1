// A few small types around the HDF5 C library. Only sources of this folder include this header.
//
// Use all types and functions only while a Lock exists: several threads of a process write runs, and not
// every build of HDF5 is thread-safe.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bendlab/io/without_traps.hpp"

namespace bendlab::hdf5 {

/// A call of HDF5 failed. what() is the system's text for the reason, or else the text of HDF5.
class Failure : public std::runtime_error {
 public:
  explicit Failure(const std::string& text, int code = 0) : std::runtime_error(text), code_(code) {}
  int code() const { return code_; }  ///< errno, 0 if the system was not the cause

 private:
  int code_;
};

/// The Failure that the error stack of HDF5 in this thread describes.
Failure last_failure();

/// The process-wide lock. Also prevents HDF5 from printing errors in this thread, and suspends floating-point
/// traps, because HDF5 converts the fill value NaN.
class Lock {
 public:
  Lock();

 private:
  std::lock_guard<std::mutex> guard_;
  WithoutTraps without_traps_;
};

/// Returns `result`, or throws last_failure() if `result` is negative.
template <class Result>
Result check(Result result) {
  if (result < 0) throw last_failure();
  return result;
}

/// Owns one identifier of the library.
class Handle {
 public:
  using Closer = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Closer closer) : id_(check(id)), close_(closer) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }
  void close() {  ///< throws Failure, unlike the destructor
    if (id_ >= 0) check(close_(std::exchange(id_, -1)));
  }

 private:
  hid_t id_ = -1;
  Closer close_ = nullptr;
};

/// The type of a number in memory, and in the file.
template <class T>
hid_t type_of() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
}

Handle create_file(const std::string& path);                 ///< fails if the file exists
Handle open_file(const std::string& path, unsigned access);  ///< H5F_ACC_RDONLY or H5F_ACC_RDWR

/// Whether the file has bytes after the end that its superblock states. A flush writes this end last. If a
/// process is killed during a flush, HDF5 does not read the data after the stated end.
bool ends_before_its_bytes(hid_t file);
/// Opens a temporary copy of a file for reading; the stated end of the copy is the end of its bytes.
Handle open_with_all_bytes(const std::string& path);

/// Creates a file that is in memory until it is closed. The file has the formats of HDF5 1.8 and 1.10, which
/// take less space than the oldest format. Fails if the file exists.
Handle create_small_file(const std::string& path);

/// Saves space in a file that is written at once and never grows. In this scope, arrays of a few numbers are
/// in the headers of their datasets, and larger arrays of up to 32 KiB are compressed.
class SmallScope {
 public:
  SmallScope();
  ~SmallScope();
  SmallScope(const SmallScope&) = delete;
  SmallScope& operator=(const SmallScope&) = delete;
};

/// Throws Failure if the disk has less space than 8 times `bytes`, because other runs may be writing, too.
/// Call this function before a flush: a file whose flush failed on a full disk may not open.
void require_room(hid_t file, std::uint64_t bytes);

/// Gives the written data to the operating system: the data survive the process, but perhaps not a power cut.
void flush(hid_t file);

/// `links` is the expected number of links. With the right number the group's header wastes no space.
Handle create_group(hid_t parent, const std::string& name, unsigned links = 4);
Handle open_group(hid_t parent, const std::string& name);
Handle open_dataset(hid_t parent, const std::string& name);
bool has_link(hid_t parent, const std::string& name);
/// Gives parent/object the second name parent/name, so that the values are stored once.
void add_link(hid_t parent, const std::string& object, const std::string& name);
std::vector<std::string> links(hid_t group);  ///< names, sorted

void write_attribute(hid_t object, const std::string& name, std::int64_t number);
void write_attribute(hid_t object, const std::string& name, std::span<const std::int64_t> numbers);
void write_ascii_attribute(hid_t object, const std::string& name, const std::string& text);

/// When an array of many numbers is compressed: always, or only in a SmallScope (`if_small`).
enum class Compression { always, if_small };
void write_array(hid_t parent, const std::string& name, hid_t type, const void* values,
                 std::span<const hsize_t> shape, Compression compression);

/// `values` row by row as (values / columns, columns), or as a vector when `columns` is 0.
template <class T>
void write_array(hid_t parent, const std::string& name, const std::vector<T>& values, hsize_t columns = 0,
                 Compression compression = Compression::always) {
  const hsize_t shape[] = {values.size() / (columns ? columns : 1), columns};
  write_array(parent, name, type_of<T>(), values.data(), std::span(shape, columns ? 2 : 1), compression);
}

std::vector<hsize_t> shape_of(hid_t dataset);
void read_rows(hid_t dataset, hid_t type, hsize_t first, hsize_t count, void* values);

/// Rows first … first + count of a dataset, row by row.
template <class T>
std::vector<T> read_rows(hid_t dataset, hsize_t first, hsize_t count) {
  const auto shape = shape_of(dataset);
  std::vector<T> values(count * (shape.size() > 1 ? shape[1] : 1));
  if (!values.empty()) read_rows(dataset, type_of<T>(), first, count, values.data());
  return values;
}

/// The first `count` rows of one column of a matrix.
std::vector<double> read_column(hid_t dataset, hsize_t column, hsize_t count);

template <class T>
std::vector<T> read_all(hid_t parent, const std::string& name) {
  const Handle dataset = open_dataset(parent, name);
  return read_rows<T>(dataset, 0, shape_of(dataset).at(0));
}

/// A dataset of floating-point numbers that grows by the same number of rows with every frame. If the disk
/// becomes full, a dataset may have grown although the values of the last rows are not written; such values
/// are read as NaN. The dataset is not compressed: gzip saves 30 % of the size of a moving cloth's frames,
/// but takes more time than all metrics together.
class Series {
 public:
  struct Layout {
    hid_t type = H5T_NATIVE_DOUBLE;  ///< in the file
    hsize_t rows = 1;                ///< per frame
    hsize_t columns = 0;             ///< 0: a vector, not a matrix
    hsize_t frames_per_chunk = 1;    ///< more than one only if a frame is small
  };
  Series() = default;
  Series(hid_t parent, const std::string& name, const Layout& layout);

  void append(std::span<const float> frame) { append(H5T_NATIVE_FLOAT, frame.data()); }
  void append(std::span<const double> frame) { append(H5T_NATIVE_DOUBLE, frame.data()); }

 private:
  void append(hid_t type, const void* frame);
  Handle dataset_;
  hsize_t rows_ = 0, columns_ = 0, size_ = 0;
};

}  // namespace bendlab::hdf5
