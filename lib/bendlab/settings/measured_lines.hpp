// Text files of measurements: words and numbers in lines, separated by spaces, tabs, commas or semicolons.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bendlab {

using LineAction = std::function<void(const std::vector<std::string_view>& words, int line)>;

/// Calls the action for each line that is not blank, with its words and its number, from 1.
void for_measured_lines(const std::string& text, const LineAction& action);

/// A finite number with a decimal point. Empty if the word is not such a number.
std::optional<double> number_in(std::string_view word);

}  // namespace bendlab
