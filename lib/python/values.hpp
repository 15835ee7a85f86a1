// Values of settings between C++ and Python.
#pragma once

#include <pybind11/pybind11.h>

#include "bendlab/settings/field.hpp"

namespace bendlab {

pybind11::object python_of(const Value& value);
/// Throws pybind11::cast_error for a value of another type.
Value value_of(FieldType type, const pybind11::handle& value);

}  // namespace bendlab
