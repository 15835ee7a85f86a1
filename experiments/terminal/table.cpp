#include "experiments/terminal/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "experiments/terminal/printable.hpp"

namespace bendlab {
namespace {

/// Width on screen in characters: UTF-8 code points, without escape sequences.
std::size_t width(std::string_view text) {
  std::size_t count = 0;
  bool escape = false;
  for (const char c : text) {
    if (c == '\x1b') escape = true;
    if (!escape && (static_cast<unsigned char>(c) & 0xC0) != 0x80) ++count;
    if (c == 'm') escape = false;
  }
  return count;
}

bool is_number(const std::string& text) {
  if (text.empty()) return true;  // an empty cell fits into a column of numbers, too
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return *end == '\0';
}

}  // namespace

void Table::add_row(std::vector<std::string> cells) {
  for (std::string& cell : cells)
    if (cell.find_first_of("\n\t") != std::string::npos) cell = printable(cell, Lines::escape);
  rows_.push_back(std::move(cells));
}

std::string Table::text() const {
  std::vector<std::size_t> widths;
  std::vector<bool> right;
  for (std::size_t column = 0; column < headings_.size(); ++column) {
    widths.push_back(width(headings_[column]));
    right.push_back(
        std::all_of(rows_.begin(), rows_.end(), [&](const auto& row) { return is_number(row[column]); }));
    for (const auto& row : rows_) widths[column] = std::max(widths[column], width(row[column]));
  }

  std::string out;
  const auto add_line = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t column = 0; column < cells.size(); ++column) {
      const std::string gap(widths[column] - width(cells[column]), ' ');
      if (column > 0) line += "  ";
      line += right[column] ? gap + cells[column] : cells[column] + gap;
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  };
  add_line(headings_);
  for (const auto& row : rows_) add_line(row);
  return out;
}

std::string format_number(double value) {
  if (std::trunc(value) == value && std::abs(value) < 1e12) return fmt::format("{:.0f}", value);
  return fmt::format("{:.4g}", value);
}

std::string format_duration(double seconds) {
  const long whole = std::lround(seconds);
  const long hours = whole / 3600, minutes = whole / 60 % 60;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60);
  return fmt::format("{}:{:02}", minutes, whole % 60);
}

}  // namespace bendlab
