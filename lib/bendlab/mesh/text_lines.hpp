// Reads a text file word by word, with line numbers for error messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace bendlab {

/// The lines of a text that hold words. A line ends with \n, \r\n or \r. A byte order mark of UTF-8 at the
/// start is skipped. The text has to outlive the object. Throws std::invalid_argument with the line number if
/// a word is missing or is not of the requested kind.
class TextLines {
 public:
  /// `comment`, if it is not 0, is the character that begins a comment, which ends with the line. `join`, if
  /// it is not 0, is a character at the end of a line's last word that continues the line in the next line; a
  /// comment may follow it.
  explicit TextLines(std::string_view text, char comment = '\0', char join = '\0');

  /// Goes to the next line with at least one word; false at the end of the text.
  bool next();
  /// The same, but the end of the text is an error: "… ends before <what>".
  void need_next(std::string_view what);

  std::size_t line() const { return line_; }  ///< number of the current line, or of its first part, from 1
  std::size_t word_count() const { return words_.size(); }
  std::string_view word(std::size_t i) const;
  double real(std::size_t i) const;  ///< nan and inf are allowed; a number that is too large is infinite
  std::int64_t integer(std::size_t i) const { return integer_of(word(i)); }
  std::int64_t integer_of(std::string_view text) const;  ///< of a part of a word
  std::size_t count(std::size_t i) const;                ///< an integer that is not negative

  /// A word for an error text: in quotes, shortened if it is long, with a ? for each byte that is not
  /// printable ASCII.
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
