#include "bendlab/settings/measured_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace bendlab {
namespace {

std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view between = " \t,;\r";
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(between); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(between, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(between, end);
  }
  return words;
}

}  // namespace

void for_measured_lines(const std::string& text, const LineAction& action) {
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::vector<std::string_view> words = words_of(std::string_view(text).substr(at, end - at));
    ++number;
    if (!words.empty()) action(words, number);
    at = end + 1;
  }
}

std::optional<double> number_in(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace bendlab
