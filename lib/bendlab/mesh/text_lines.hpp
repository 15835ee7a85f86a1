// Reads a text file word by word, with line numbers for error messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace bendlab {

/// The lines of a text that are not blank. A line ends with \n, \r\n or \r. A UTF-8 byte order mark at the
/// start is skipped. The text has to exist as long as the object. Throws std::invalid_argument with the line
/// number if a word is missing, or is not a number where a number is needed.
class TextLines {
 public:
  /// `comment` is the character that begins a comment, which ends with the line. If the last word of a line
  /// ends with the character `join`, the next line is appended to that line. 0 means no such character.
  explicit TextLines(std::string_view text, char comment = '\0', char join = '\0');

  /// Goes to the next line with at least one word; false at the end of the text.
  bool next();
  /// Like next(), but throws at the end of the text: "… ends before <what>".
  void need_next(std::string_view what);

  std::size_t line() const { return line_; }  ///< number of the current line, or of its first part; from 1
  std::size_t word_count() const { return words_.size(); }
  std::string_view word(std::size_t i) const;
  double real(std::size_t i) const;  ///< may be nan or inf; a number that is too large is infinite
  std::int64_t integer(std::size_t i) const { return integer_of(word(i)); }
  std::int64_t integer_of(std::string_view text) const;  ///< from a part of a word
  std::size_t count(std::size_t i) const;                ///< an integer that is not negative

  /// A word for an error text: in quotes and not too long. Each byte that is not printable ASCII becomes a ?.
  static std::string quoted(std::string_view text);
  std::string quoted(std::size_t i) const { return quoted(word(i)); }

  std::string_view rest() const { return rest_; }  ///< the text after the current line
  [[noreturn]] void fail(std::string_view what) const;

 private:
  std::string_view take_line();
  void split(std::string_view line);

  std::string_view rest_;
  char comment_, join_;
  bool pairs_ = true;  // \r\n is one end of a line, not two
  std::vector<std::string_view> words_;
  std::size_t line_ = 0, lines_taken_ = 0;
};

}  // namespace bendlab
