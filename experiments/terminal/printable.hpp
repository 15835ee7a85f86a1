// Makes texts from configs, run files, plans and file names safe to print on a terminal.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace bendlab {

enum class Lines { keep, escape };

/// The text with unsafe characters escaped as in JSON, for example `\u001b`. Unsafe are control characters
/// (C0, C1, delete) and characters that change the direction of text. A byte that is no UTF-8 becomes
/// `\ufffd`. `Lines::keep` keeps new lines and tabs.
std::string printable(std::string_view text, Lines lines = Lines::keep);

enum class Colour { green, red, yellow, dim };

/// Whether `stream` is a terminal and NO_COLOR is not set.
bool has_colours(std::FILE* stream);

/// The text in `colour` if `stream` has colours, else unchanged.
std::string coloured(std::string_view text, Colour colour, std::FILE* stream);

/// Prints printable(text), but keeps the colours of coloured() if the stream has colours. Throws
/// std::system_error if the stream cannot be written.
void print_printable(std::FILE* stream, std::string_view text);

/// Like fmt::print, but prints with print_printable().
template <class... Values>
void print_text(std::FILE* stream, fmt::format_string<Values...> format, Values&&... values) {
  print_printable(stream, fmt::format(format, std::forward<Values>(values)...));
}
template <class... Values>
void print_text(fmt::format_string<Values...> format, Values&&... values) {
  print_printable(stdout, fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace bendlab
