// The HDF5 C library behind a few small types. Only sources of this folder include this header.
//
// Use everything here under a Lock: threads of one process write several runs, and not every build of the
// library is thread-safe.
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

/// A call of the library failed. what() is the reason: the system's text if there is one, else the library's.
class Failure : public std::runtime_error {
 public:
  explicit Failure(const std::string& text, int code = 0) : std::runtime_error(text), code_(code) {}
  int code() const { return code_; }  ///< errno, 0 if the system was not the cause

 private:
  int code_;
};

/// The Failure that the library's error stack of this thread describes.
Failure last_failure();

/// The process-wide lock. Also turns off the library's own printing, which every thread has to do, and
/// suspends floating-point traps, so that the library may convert a NaN as a fill value.
class Lock {
 public:
  Lock();

 private:
  std::lock_guard<std::mutex> guard_;
  WithoutTraps without_traps_;
};

/// Returns the result, or throws last_failure() if it is negative.
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

/// Whether the file has bytes after the end that it states. A flush writes this end last. So a process that
/// is killed during a flush may leave data after the stated end, which HDF5 then refuses to read.
bool ends_before_its_bytes(hid_t file);
/// Opens a temporary copy of such a file for reading, with all its bytes.
Handle open_with_all_bytes(const std::string& path);

/// Creates a file that is in memory until it is closed. It has the formats of HDF5 1.8 and 1.10, which take
/// less space than the oldest format. Fails if the file exists.
Handle create_small_file(const std::string& path);

/// For a file that is written at once and never grows: in this scope, arrays of a few numbers lie in the
/// headers of their datasets, and larger arrays of up to 32 KiB are compressed.
class SmallScope {
 public:
  SmallScope();
  ~SmallScope();
  SmallScope(const SmallScope&) = delete;
  SmallScope& operator=(const SmallScope&) = delete;
};

/// Throws Failure unless the disk has room for 8 times `bytes`, because other runs may be writing, too. Call
/// it before a flush: a flush that fails half-way on a full disk can leave a file that doesn't open.
void require_room(hid_t file, std::uint64_t bytes);

/// Hands the written data to the operating system. They survive the end of the process, but perhaps not a
/// power cut.
void flush(hid_t file);

/// `links` is the number of links that the group will have, if that is known. Then its header takes no more
/// room than it needs.
Handle create_group(hid_t parent, const std::string& name, unsigned links = 4);
Handle open_group(hid_t parent, const std::string& name);
Handle open_dataset(hid_t parent, const std::string& name);
bool has_link(hid_t parent, const std::string& name);
/// Gives parent/object a second name, parent/name, instead of a copy with the same values.
void add_link(hid_t parent, const std::string& object, const std::string& name);
std::vector<std::string> links(hid_t group);  ///< names, sorted

void write_attribute(hid_t object, const std::string& name, std::int64_t number);
void write_attribute(hid_t object, const std::string& name, std::span<const std::int64_t> numbers);
void write_ascii_attribute(hid_t object, const std::string& name, const std::string& text);

/// When an array of many numbers is compressed. `if_small` means only in a SmallScope.
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

/// A dataset of floating-point numbers that grows by the same number of rows with every frame. Rows that were
/// never written read as NaN: on a full disk, a dataset may grow without its values being written. The
/// dataset is not compressed: gzip saves 30 % of a moving cloth's frames, but takes more time than all
/// metrics together.
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
