// An aligned table for a terminal.
#pragma once

#include <string>
#include <vector>

namespace bendlab {

class Table {
 public:
  explicit Table(std::vector<std::string> headings) : headings_(std::move(headings)) {}

  /// `cells` has one cell per heading. The row is printed on one line.
  void add_row(std::vector<std::string> cells);

  /// Headings and rows, one line each. Columns of numbers are aligned right, other columns left.
  std::string text() const;

 private:
  std::vector<std::string> headings_;
  std::vector<std::vector<std::string>> rows_;
};

/// Four significant digits; whole numbers below 10¹² in full.
std::string format_number(double value);

/// "0:07", "12:34", "1:02:03".
std::string format_duration(double seconds);

}  // namespace bendlab
