// A family that a program may add to: bending models, measures. Its rows are those of the .def list, and then
// those that the program registers before anybody reads them.
#pragma once

#include <atomic>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace bendlab {

namespace detail {
/// Throws std::invalid_argument if the name cannot be a key of a config, or if it is taken; std::logic_error
/// if it comes too late.
void check_new_name(std::string_view family, std::string_view name, std::span<const std::string_view> taken,
                    bool too_late);

constexpr std::string_view name_of_row(std::string_view name) {
  return name;
}
template <class Row>
constexpr std::string_view name_of_row(const Row* row) {
  return row->name;
}
}  // namespace detail

/// `Row`: a name, or a pointer to what has one.
template <class Row>
class Registry {
 public:
  /// `family`: "bending model", for messages.
  Registry(std::string_view family, std::span<const Row> listed)
      : family_(family), rows_(listed.begin(), listed.end()), listed_(listed.size()) {}

  /// Throws std::invalid_argument for a name that is taken or no name, std::logic_error after the first
  /// rows(): tables of settings were made of them. For one thread.
  void add(Row row) {
    std::vector<std::string_view> taken;
    for (const Row& each : rows_) taken.push_back(detail::name_of_row(each));
    detail::check_new_name(family_, detail::name_of_row(row), taken, was_read_);
    rows_.push_back(row);
  }

  /// All, which from here on are all that there will be.
  std::span<const Row> rows() {
    was_read_.store(true, std::memory_order_relaxed);
    return rows_;
  }

  std::span<const Row> so_far() const { return rows_; }                             ///< more may be added
  std::span<const Row> added() const { return std::span(rows_).subspan(listed_); }  ///< without those listed

 private:
  std::string_view family_;
  std::vector<Row> rows_;
  std::size_t listed_;
  std::atomic<bool> was_read_{false};
};

}  // namespace bendlab
