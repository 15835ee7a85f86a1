// Bending models, effects and measures that are written in Python.
#pragma once

#include <pybind11/pybind11.h>

namespace bendlab {

/// Adds functions to the extension module that register such models, effects and measures.
void add_own_parts(pybind11::module_& module);

}  // namespace bendlab
