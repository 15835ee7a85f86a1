#include "values.hpp"

#include <pybind11/stl.h>

namespace py = pybind11;

namespace bendlab {

py::object python_of(const Value& value) {
  return std::visit(
      []<class T>(const T& plain) -> py::object {
        if constexpr (std::is_same_v<T, std::monostate>)
          return py::none();
        else
          return py::cast(plain);
      },
      value);
}

Value value_of(FieldType type, const py::handle& value) {
  switch (type) {
    case FieldType::boolean:
      return py::cast<bool>(value);
    case FieldType::integer:
      return py::cast<std::int64_t>(value);
    case FieldType::number:
      return py::cast<double>(value);
    case FieldType::text:
      return py::cast<std::string>(value);
    case FieldType::integers:
      return py::cast<std::vector<std::int64_t>>(value);
    case FieldType::numbers:
      return py::cast<std::vector<double>>(value);
    case FieldType::texts:
      return py::cast<std::vector<std::string>>(value);
  }
  return {};
}

}  // namespace bendlab
