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
