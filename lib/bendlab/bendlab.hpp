// Everything that a program needs to make a cloth and step it.
#pragma once

#include "bendlab/scene/scene_json.hpp"
#include "bendlab/scene/simulate.hpp"
