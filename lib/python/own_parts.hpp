// Bending models, effects and measures that are written in Python.
#pragma once

#include <pybind11/pybind11.h>

namespace bendlab {

/// Adds the functions that register them to the extension module.
void add_own_parts(pybind11::module_& module);

}  // namespace bendlab
