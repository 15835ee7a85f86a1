// A text file word by word, with line numbers for its errors.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace bendlab {

/// The lines of a text that hold words. The text has to outlive the object. Throws std::invalid_argument with
/// the line if something does not fit.
class TextLines {
 public:
  /// Ignores the rest of a line from the character `comment` on, if it is not 0.
  explicit TextLines(std::string_view text, char comment = '\0') : rest_(text), comment_(comment) {}

  /// Goes to the next line with at least one word; false at the end of the text.
  bool next();
  /// The same, but the end of the text is an error: "… ends before <what>".
  void need_next(std::string_view what);

  std::size_t word_count() const { return words_.size(); }
  std::string_view word(std::size_t i) const;
  double real(std::size_t i) const;  ///< nan and inf are allowed; too large is infinite
  std::int64_t integer(std::size_t i) const;
  std::size_t count(std::size_t i) const;  ///< an integer that is not negative

  /// The word for an error text: in quotes, cut if it is long, without control and other unusual characters.
  std::string quoted(std::size_t i) const;

  std::string_view rest() const { return rest_; }  ///< what follows the current line
  [[noreturn]] void fail(std::string_view what) const;

 private:
  std::string_view rest_;
  char comment_;
  std::vector<std::string_view> words_;
  std::size_t line_ = 0;
};

}  // namespace bendlab
