#include "experiments/terminal/printable.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <system_error>

namespace bendlab {
namespace {

// A UTF-8 character; `bytes` is 0 if the text does not begin with a valid character.
struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;
};

Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t bytes = byte(0) < 0x80             ? 1
                            : (byte(0) & 0xE0) == 0xC0 ? 2
                            : (byte(0) & 0xF0) == 0xE0 ? 3
                            : (byte(0) & 0xF8) == 0xF0 ? 4
                                                       : 0;
  if (bytes == 0 || bytes > text.size()) return {};
  std::uint32_t code = bytes == 1 ? byte(0) : byte(0) & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    code = (code << 6) | (byte(i) & 0x3Fu);
  }
  // The smallest code that may have each length in bytes. A smaller code must have a shorter encoding.
  constexpr std::array<std::uint32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < least[bytes] || code > 0x10FFFF || surrogate ? Character{} : Character{code, bytes};
}

bool turns_direction(std::uint32_t code) {  // Unicode's Bidi_Control and line separators
  return code == 0x061C || code == 0x200E || code == 0x200F || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}

bool is_harmless(std::uint32_t code, Lines lines) {
  if (code == '\n' || code == '\t') return lines == Lines::keep;
  return code >= 0x20 && !(code >= 0x7F && code <= 0x9F) && !turns_direction(code);
}

// The length of the colour sequence of coloured() at the start of the text; 0 if there is none.
std::size_t colour_length(std::string_view text) {
  for (const std::string_view sequence : {"\x1b[0m", "\x1b[2m", "\x1b[31m", "\x1b[32m", "\x1b[33m"})
    if (text.starts_with(sequence)) return sequence.size();
  return 0;
}

std::string escaped(std::string_view text, Lines lines, bool colours) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const auto plain = std::ranges::find_if(text, [](char c) { return c < ' ' || c > '~'; });
    result.append(text.begin(), plain);
    text.remove_prefix(static_cast<std::size_t>(plain - text.begin()));
    if (text.empty()) break;
    const Character character = first_of(text);
    std::size_t bytes = std::max<std::size_t>(character.bytes, 1);
    if (const std::size_t colour = colours ? colour_length(text) : 0; colour > 0)
      result += text.substr(0, bytes = colour);
    else if (character.bytes == 0)
      result += "\\ufffd";
    else if (is_harmless(character.code, lines))
      result += text.substr(0, bytes);
    else
      result += fmt::format("\\u{:04x}", character.code);
    text.remove_prefix(bytes);
  }
  return result;
}

}  // namespace

std::string printable(std::string_view text, Lines lines) {
  return escaped(text, lines, false);
}

bool has_colours(std::FILE* stream) {
  const char* no_color = std::getenv("NO_COLOR");
  const bool wanted = no_color == nullptr || *no_color == '\0';
  return wanted && isatty(fileno(stream)) != 0;
}

std::string coloured(std::string_view text, Colour colour, std::FILE* stream) {
  if (!has_colours(stream)) return std::string(text);
  constexpr std::array codes = {32, 31, 33, 2};  // in the order of Colour
  const int code = codes.at(static_cast<std::size_t>(colour));
  return fmt::format("\x1b[{}m{}\x1b[0m", code, text);
}

void print_printable(std::FILE* stream, std::string_view text) {
  const std::string safe_text = escaped(text, Lines::keep, has_colours(stream));
  if (std::fwrite(safe_text.data(), 1, safe_text.size(), stream) < safe_text.size())
    throw std::system_error(errno, std::generic_category(), "cannot write to file");
}

}  // namespace bendlab
