// What most files of the experiments and their tests include besides the library's; see lib/precompiled.hpp.
#pragma once

#include <fmt/ranges.h>

#include <chrono>
#include <nlohmann/json.hpp>
