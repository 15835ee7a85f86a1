#include "bendlab/mesh/text_lines.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <stdexcept>

namespace bendlab {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

template <class Number>
std::errc parse(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end != text.data() + text.size() ? std::errc::invalid_argument : error;
}

}  // namespace

bool TextLines::next() {
  words_.clear();
  while (words_.empty() && !rest_.empty()) {
    std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
    ++line_;
    if (comment_ != '\0') line = line.substr(0, line.find(comment_));
    for (std::size_t start = line.find_first_not_of(blanks); start != line.npos;) {
      const std::size_t end = std::min(line.find_first_of(blanks, start), line.size());
      words_.push_back(line.substr(start, end - start));
      start = line.find_first_not_of(blanks, end);
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
  if (error == std::errc::result_out_of_range) {  // from_chars does not say on which side
    const bool tiny =
        word(i).find("e-") != std::string_view::npos || word(i).find("E-") != std::string_view::npos;
    return tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  if (error != std::errc()) fail(quoted(i) + " is not a number");
  return value;
}

std::int64_t TextLines::integer(std::size_t i) const {
  std::int64_t value = 0;
  if (parse(word(i), value) != std::errc()) fail(quoted(i) + " is not a whole number");
  return value;
}

std::size_t TextLines::count(std::size_t i) const {
  const std::int64_t value = integer(i);
  if (value < 0) fail(fmt::format("{} is no count", value));
  return static_cast<std::size_t>(value);
}

std::string TextLines::quoted(std::size_t i) const {
  constexpr std::size_t longest = 40;
  std::string text(word(i).substr(0, longest));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return "'" + text + (word(i).size() > longest ? "…'" : "'");
}

void TextLines::fail(std::string_view what) const {
  throw std::invalid_argument(fmt::format("line {}: {}", line_, what));
}

}  // namespace bendlab
