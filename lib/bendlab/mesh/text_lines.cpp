#include "bendlab/mesh/text_lines.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <stdexcept>

namespace bendlab {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

template <class Number>
std::errc parse(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end != text.data() + text.size() ? std::errc::invalid_argument : error;
}

}  // namespace

TextLines::TextLines(std::string_view text, char comment, char join)
    : rest_(text), comment_(comment), join_(join) {
  if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
  // If the lines end with \r alone, a \n after the header's last \r is the first byte of binary data.
  const std::size_t end = rest_.find_first_of("\r\n");
  pairs_ = end == rest_.npos || rest_.substr(end, 2) == "\r\n" || rest_[end] == '\n';
}

std::string_view TextLines::take_line() {
  std::size_t end = 0;
  while (end < rest_.size() && rest_[end] != '\n' && rest_[end] != '\r') ++end;
  const std::string_view line = rest_.substr(0, end);
  const bool pair = pairs_ && rest_.substr(end, 2) == "\r\n";
  rest_.remove_prefix(std::min(end + (pair ? 2 : 1), rest_.size()));
  ++lines_taken_;
  return line;
}

void TextLines::split(std::string_view line) {
  const char *at = line.data(), *const end = at + line.size();
  while (true) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return;
    const char* const start = at;
    while (at != end && !is_blank(*at)) ++at;
    words_.emplace_back(start, static_cast<std::size_t>(at - start));
  }
}

bool TextLines::next() {
  words_.clear();
  while (words_.empty() && !rest_.empty()) {
    line_ = lines_taken_ + 1;
    for (bool joined = true; joined && !rest_.empty();) {
      std::string_view line = take_line();
      if (comment_ != '\0') line = line.substr(0, line.find(comment_));
      split(line);
      joined = join_ != '\0' && !words_.empty() && words_.back().ends_with(join_);
      if (!joined) continue;
      words_.back().remove_suffix(1);
      if (words_.back().empty()) words_.pop_back();
    }
  }
  return !words_.empty();
}

void TextLines::need_next(std::string_view what) {
  if (!next()) fail(fmt::format("the file ends before {}", what));
}

std::string_view TextLines::word(std::size_t i) const {
  if (i >= words_.size()) fail(fmt::format("{} words are too few", words_.size()));
  return words_[i];
}

double TextLines::real(std::size_t i) const {
  double value = 0;
  const std::errc error = parse(word(i), value);
  if (error == std::errc::result_out_of_range)  // from_chars does not say if too large or too small
    return std::strtod(std::string(word(i)).c_str(), nullptr);
  if (error != std::errc()) fail(quoted(i) + " is not a number");
  return value;
}

std::int64_t TextLines::integer_of(std::string_view text) const {
  std::int64_t value = 0;
  const std::errc error = parse(text, value);
  if (error == std::errc::result_out_of_range) fail(quoted(text) + " is too large a number");
  if (error != std::errc()) fail(quoted(text) + " is not a whole number");
  return value;
}

std::size_t TextLines::count(std::size_t i) const {
  const std::int64_t value = integer(i);
  if (value < 0) fail(fmt::format("a count is {}, but it must not be negative", value));
  return static_cast<std::size_t>(value);
}

std::string TextLines::quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string printable(text.substr(0, longest));
  for (char& c : printable)
    if (c < ' ' || c > '~') c = '?';
  return "'" + printable + (text.size() > longest ? "…'" : "'");
}

void TextLines::fail(std::string_view what) const {
  throw std::invalid_argument(fmt::format("line {}: {}", line_, what));
}

}  // namespace bendlab
