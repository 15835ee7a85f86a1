// All that a program needs which makes a cloth and steps it.
#pragma once

#include "bendlab/scene/scene_json.hpp"
#include "bendlab/scene/simulate.hpp"
