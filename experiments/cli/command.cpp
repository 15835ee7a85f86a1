#include "experiments/cli/command.hpp"

#include <algorithm>
#include <sstream>

namespace bendlab {

Option::Option(std::string_view usage, OptionVariable target, std::string help, const Range& allowed)
    : variable(target), meaning(std::move(help)), range(allowed) {
  const std::size_t space = std::min(usage.find(' '), usage.size());
  name = usage.substr(0, space);
  type = usage.substr(std::min(space + 1, usage.size()));
  required = name.starts_with('-') ? name.ends_with('!') : !name.starts_with('[');
  std::erase_if(name, [](char c) { return c == '!' || c == '[' || c == ']'; });
  by_commas = type.ends_with(",...");
  separate = !by_commas && type.ends_with("...");
  type.resize(std::min(type.find(by_commas ? ",..." : "..."), type.size()));
  if (type.find('|') == type.npos) return;
  std::istringstream words(std::exchange(type, ""));
  for (std::string word; std::getline(words, word, '|');) choices.push_back(word);
}

}  // namespace bendlab
