// An aligned table for a terminal.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace bendlab {

class Table {
 public:
  explicit Table(std::vector<std::string> headings) : headings_(std::move(headings)) {}

  /// One cell per heading, shown on one line.
  void add_row(std::vector<std::string> cells);

  /// Headings and rows, a line each. A column of numbers is aligned right, any other left.
  std::string text() const;

 private:
  std::vector<std::string> headings_;
  std::vector<std::vector<std::string>> rows_;
};

/// Four significant digits; whole numbers below 10¹² in full.
std::string format_number(double value);

/// "0:07", "12:34", "1:02:03".
std::string format_duration(double seconds);

enum class Colour { green, red, yellow, dim };

/// Whether `stream` is a terminal and NO_COLOR is not set.
bool has_colours(std::FILE* stream);

/// The text in that colour if `stream` has colours, else as it is.
std::string coloured(std::string_view text, Colour colour, std::FILE* stream);

}  // namespace bendlab
