// Computes experiments from Python, as `bendlab run` does.
#pragma once

#include <pybind11/pybind11.h>

namespace bendlab {

/// Adds run() to the extension module.
void add_runs(pybind11::module_& module);

}  // namespace bendlab
