// What a terminal may be given of texts that others wrote: configs, run files, plans, names of files.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace bendlab {

enum class Lines { keep, escape };

/// The text with control characters (C0, C1, delete), characters that turn the direction of text, and bytes
/// that are no UTF-8 written out as `\u001b`, which JSON reads as what it was. `Lines::keep`: new lines and
/// tabs stay.
std::string printable(std::string_view text, Lines lines = Lines::keep);

enum class Colour { green, red, yellow, dim };

/// Whether `stream` is a terminal and NO_COLOR is not set.
bool has_colours(std::FILE* stream);

/// The text in that colour if `stream` has colours, else as it is.
std::string coloured(std::string_view text, Colour colour, std::FILE* stream);

/// Prints printable(text). The colours of coloured() stay if the stream is one that has them. Throws
/// std::system_error if nothing can be written there.
void print_printable(std::FILE* stream, std::string_view text);

/// As fmt::print, of what is printable.
template <class... Values>
void print_text(std::FILE* stream, fmt::format_string<Values...> format, Values&&... values) {
  print_printable(stream, fmt::format(format, std::forward<Values>(values)...));
}
template <class... Values>
void print_text(fmt::format_string<Values...> format, Values&&... values) {
  print_printable(stdout, fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace bendlab
