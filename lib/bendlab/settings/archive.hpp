// Stores the state of a run as bytes, so that the run can be continued later.
#pragma once

#include <Eigen/Core>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace bendlab {

/// Writes values to bytes, or reads values from bytes. A class lists its members once for both directions:
///
///   void archive(Archive& a) { a(position_, velocity_, steps_); }
///
/// Values are copied as bytes, so only the same program, on the same kind of machine, can read the result.
class Archive {
 public:
  Archive() = default;                                                             ///< writes
  explicit Archive(std::string bytes) : bytes_(std::move(bytes)), reads_(true) {}  ///< reads

  bool reads() const { return reads_; }
  const std::string& bytes() const { return bytes_; }
  bool at_end() const { return !reads_ || at_ == bytes_.size(); }

  /// Allowed values are numbers, enumerators, structs without pointers, strings, vectors, optionals, dense
  /// matrices, and types with a member function archive(Archive&). When reading, throws std::runtime_error if
  /// there are too few bytes, or if a matrix of fixed size has another size.
  template <class... Values>
  void operator()(Values&... values) {
    (value(values), ...);
  }

 private:
  template <class T>
  void value(T& v) {
    if constexpr (requires { v.archive(*this); })
      v.archive(*this);
    else if constexpr (std::is_same_v<T, bool>)
      truth(v);
    else if constexpr (std::is_trivially_copyable_v<T>)
      raw(&v, sizeof(T));
    else
      list(v);
  }
  // Does not copy the byte of a bool with raw(), because only two values of that byte are valid.
  void truth(bool& v) {
    auto byte = static_cast<unsigned char>(v);
    raw(&byte, sizeof byte);
    v = byte != 0;
  }
  template <class T>
  void value(std::optional<T>& v) {
    bool there = v.has_value();
    truth(there);
    if (reads_) v = there ? std::optional<T>(T{}) : std::nullopt;
    if (there) value(*v);
  }
  template <class Scalar, int rows, int columns, int options>
  void value(Eigen::Matrix<Scalar, rows, columns, options>& v) {
    Eigen::Index size[] = {v.rows(), v.cols()};
    raw(size, sizeof size);
    if (reads_) {
      const auto left = static_cast<Eigen::Index>((bytes_.size() - at_) / sizeof(Scalar));
      if ((rows != Eigen::Dynamic && size[0] != rows) || (columns != Eigen::Dynamic && size[1] != columns))
        throw std::runtime_error("the archive has a matrix of a different size");
      if (size[0] < 0 || size[1] < 0 || (size[0] > 0 && size[1] > left / size[0])) throw_too_short();
      v.resize(size[0], size[1]);
    }
    raw(v.data(), static_cast<std::size_t>(v.size()) * sizeof(Scalar));
  }

  // Texts and vectors.
  template <class List>
  void list(List& v) {
    using Element = typename List::value_type;
    std::size_t size = v.size();
    raw(&size, sizeof size);
    if (reads_) {
      require(size);
      v.resize(size);
    }
    if constexpr (std::is_trivially_copyable_v<Element> && !requires(Element e) { e.archive(*this); })
      raw(v.data(), size * sizeof(Element));
    else
      for (Element& element : v) value(element);
  }

  void raw(void* data, std::size_t size) {
    if (!reads_) {
      bytes_.append(static_cast<const char*>(data), size);
      return;
    }
    require(size);
    if (size > 0) std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
  }

  void require(std::size_t size) const {
    if (size > bytes_.size() - at_) throw_too_short();
  }
  [[noreturn]] static void throw_too_short() { throw std::runtime_error("the archive has too few bytes"); }

  std::string bytes_;
  std::size_t at_ = 0;
  bool reads_ = false;
};

}  // namespace bendlab
