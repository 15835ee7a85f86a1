#include "bendlab/scene/strict_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <span>

#include "bendlab/scene/counted.hpp"
#include "bendlab/scene/json_text.hpp"

namespace bendlab {
namespace {

constexpr std::size_t deepest_nesting = 64;  // a config needs 5; dump() recurses and would overflow the stack
constexpr std::size_t most_keys = 1000;  // in an object; there are 200 settings; keys are searched linearly

std::string error_text(std::string_view source, const ConfigProblems& problems) {
  constexpr std::size_t most_listed = 100;
  std::string text = fmt::format("{}: {}", source, counted(problems.size(), "problem"));
  // Not std::views: clang 14, which builds the fuzzers on Debian 12, cannot compile libstdc++'s std::views.
  for (const ConfigProblem& problem : std::span(problems).first(std::min(most_listed, problems.size())))
    text +=
        fmt::format("\n  {}: {}", problem.pointer.empty() ? "(top level)" : problem.pointer, problem.message);
  if (problems.size() > most_listed) text += fmt::format("\n  and {} more", problems.size() - most_listed);
  return text;
}

// The position of the byte at `offset`, such as "line 3, column 7". Columns count characters, not bytes.
std::string place_text(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::string_view in_line = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0
  const auto column =
      1 + std::count_if(in_line.begin(), in_line.end(), [](char c) { return (c & 0xC0) != 0x80; });
  return fmt::format("line {}, column {}", line, column);
}

// The error text of the library nlohmann::json, without error number and position.
std::string syntax_text(std::string_view what) {
  const std::size_t start = what.find("syntax error");
  return std::string(start == std::string_view::npos ? what.substr(what.find(']') + 2) : what.substr(start));
}

// Builds the document, because nlohmann::json itself accepts duplicate keys and any depth of nesting.
class DocumentBuilder : public nlohmann::json_sax<Json> {
 public:
  DocumentBuilder(std::string_view text, ConfigProblems& problems) : text_(text), problems_(problems) {}

  Json take_document() { return std::move(document_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t&) override { return false; }  // does not occur in JSON text

  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    if (++level.keys > most_keys) {
      problems_.push_back(
          {pointer(levels_.size() - 1),
           fmt::format("has more than {} keys, the most that are allowed: remove keys", most_keys)});
      return false;
    }
    level.key = name;
    level.duplicate = level.container->contains(name);
    if (level.duplicate)
      problems_.push_back({child_pointer(pointer(levels_.size() - 1), name),
                           "the object has this key twice; remove one of the entries"});
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    if (error.id == 406) {  // number overflow; `position` is behind the number's last character
      const std::size_t start = position - std::min(position, token.size());
      problems_.push_back(
          {pointer(levels_.size()),
           fmt::format("{}: {} is not finite: numbers go to ±1.8e308", place_text(text_, start), token)});
    } else {
      problems_.push_back(
          {"", fmt::format("{}: not JSON: {}", place_text(text_, position == 0 ? 0 : position - 1),
                           syntax_text(error.what()))});
    }
    return false;
  }

 private:
  struct Level {
    Json* container;
    std::string key;         // key of the next value, in an object
    bool duplicate = false;  // the value is read, but not used
    std::size_t keys = 0;    // so far
  };

  // Pointer to the value being read in the object or list levels_[depth - 1]; depth 0 is the document.
  std::string pointer(std::size_t depth) const {
    std::string result;
    for (std::size_t i = 0; i < depth; ++i) {
      const Level& level = levels_[i];
      const std::size_t open_inside = i + 1 < levels_.size() ? 1 : 0;  // the open value is in the list
      result = child_pointer(result, level.container->is_array()
                                         ? std::to_string(level.container->size() - open_inside)
                                         : level.key);
    }
    return result;
  }

  Json& place_for_value() {
    if (levels_.empty()) return document_;
    Level& level = levels_.back();
    if (level.container->is_array()) return level.container->emplace_back();
    return level.duplicate ? dropped_.emplace_back() : (*level.container)[level.key];
  }

  bool add(Json value) {
    place_for_value() = std::move(value);
    return true;
  }

  bool open(Json container) {
    if (levels_.size() == deepest_nesting) {
      problems_.push_back({"", fmt::format("nested deeper than {} levels", deepest_nesting)});
      return false;
    }
    Json& place = place_for_value();
    place = std::move(container);
    levels_.push_back({&place, {}});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  std::string_view text_;
  ConfigProblems& problems_;
  Json document_;
  std::vector<Level> levels_;
  std::deque<Json> dropped_;  // a deque, because Level::container may point into it
};

}  // namespace

std::string child_pointer(std::string_view parent, std::string_view key) {
  std::string pointer(parent);  // RFC 6901; fast, because thousands of runs call it for every setting
  pointer += '/';
  for (const char c : key)
    if (c == '~')
      pointer += "~0";
    else if (c == '/')
      pointer += "~1";
    else
      pointer += c;
  return pointer;
}

std::string given_text(const Json& given) {
  if (given.is_object()) return "an object";
  if (given.is_array()) return given.empty() ? "an empty list" : fmt::format("a list of {}", given.size());
  constexpr std::size_t longest = 60;
  const std::string dumped = json_text(given);
  std::size_t end = std::min(longest, dumped.size());
  while (end < dumped.size() && (dumped[end] & 0xC0) == 0x80) --end;  // not within a character
  return (given.is_string() ? "the text " : "") + dumped.substr(0, end) + (end < dumped.size() ? "…" : "");
}

ConfigError::ConfigError(std::string_view source, ConfigProblems problems)
    : std::runtime_error(error_text(source, problems)), problems_(std::move(problems)) {}

std::optional<Json> read_strict_json(std::string_view text, ConfigProblems& problems) {
  if (text.starts_with("\xEF\xBB\xBF")) {
    problems.push_back(
        {"", "line 1, column 1: has a byte order mark; save the file as UTF-8 without this mark"});
    return std::nullopt;
  }
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    problems.push_back({"", "is empty, but a config must be a JSON object with at least a \"name\""});
    return std::nullopt;
  }
  DocumentBuilder builder(text, problems);
  if (!Json::sax_parse(text.begin(), text.end(), &builder)) return std::nullopt;
  return builder.take_document();
}

Json parse_strict_json(std::string_view text, std::string_view source_name) {
  ConfigProblems problems;
  std::optional<Json> document = read_strict_json(text, problems);
  if (!problems.empty()) throw ConfigError(source_name, std::move(problems));
  return *std::move(document);
}

}  // namespace bendlab
