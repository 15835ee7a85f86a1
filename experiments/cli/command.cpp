#include "experiments/cli/command.hpp"

#include <utility>

namespace bendlab {
namespace {

bool remove_suffix(std::string_view& text, std::string_view end) {
  if (!text.ends_with(end)) return false;
  text.remove_suffix(end.size());
  return true;
}

}  // namespace

Option::Option(std::string_view usage, OptionVariable variable_, std::string meaning_, const Range& range_)
    : variable(variable_), meaning(std::move(meaning_)), range(range_) {
  const std::size_t space = std::min(usage.find(' '), usage.size());
  std::string_view name_there = usage.substr(0, space),
                   value = usage.substr(std::min(space + 1, usage.size()));
  if (name_there.starts_with('-'))
    required = remove_suffix(name_there, "!");
  else if (name_there.starts_with('['))
    name_there = name_there.substr(1, name_there.size() - 2);
  else
    required = true;
  name = name_there;
  by_commas = remove_suffix(value, ",...");
  separate = remove_suffix(value, "...");
  if (value.find('|') == value.npos) {
    type = value;
    return;
  }
  while (!value.empty()) {
    const std::size_t end = std::min(value.find('|'), value.size());
    choices.emplace_back(value.substr(0, end));
    value.remove_prefix(std::min(end + 1, value.size()));
  }
}

}  // namespace bendlab
