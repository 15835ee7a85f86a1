// The extension module of the Python package: tables of settings, and cloths.
#include <pybind11/stl.h>

#include <span>

#include "bendlab/mesh/files.hpp"
#include "bendlab/scene/fields_json.hpp"
#include "bendlab/scene/scene_tables.hpp"
#include "cloth.hpp"
#include "own_parts.hpp"
#include "readers.hpp"
#include "runs.hpp"
#include "values.hpp"

namespace py = pybind11;

namespace bendlab {
namespace {

py::str text(std::string_view text) {
  return {text.data(), text.size()};
}

std::string_view type_name(const Field& field) {
  switch (field.type) {
    case FieldType::boolean:
      return "bool";
    case FieldType::integer:
      return "int";
    case FieldType::number:
      return "float";
    case FieldType::text:
      return "str";
    case FieldType::integers:
      return "Sequence[int]";
    case FieldType::numbers:
      return "Sequence[float]";
    case FieldType::texts:
      return "Sequence[str]";
  }
  return "";
}

// A struct of settings: its table, and the texts for the documentation of its Python class.
struct Table {
  std::string name, pointer, meaning;
  FieldTable table;

  std::vector<py::dict> fields() const {
    std::vector<py::dict> rows;
    for (const Field& field : table.fields) {
      std::vector<py::str> choices;
      for (const std::string_view choice : field.choices) choices.push_back(text(choice));
      using namespace py::literals;
      rows.push_back(py::dict("name"_a = text(field.name), "unit"_a = text(field.unit),
                              "meaning"_a = text(field.meaning), "type"_a = text(type_name(field)),
                              "default"_a = python_of(table.default_of(field)), "optional"_a = field.optional,
                              "required"_a = field.required, "choices"_a = choices,
                              "expected"_a = expected_text(field), "minimum"_a = field.minimum,
                              "maximum"_a = field.maximum, "above"_a = field.above));
    }
    return rows;
  }

  // The value of a setting as the program reads it. Throws ConfigError.
  py::object read(const std::string& setting, const std::string& json) const {
    const std::shared_ptr<void> owner = table.copy(table.defaults());
    ConfigProblems problems;
    read_fields(table, owner.get(), Json{{setting, parse_strict_json(json, pointer)}}, pointer, {}, problems);
    if (!problems.empty()) throw ConfigError(name, std::move(problems));
    return python_of(table.find(setting)->of(owner.get()));
  }
};

template <class Kind>
std::vector<Table> tables_of(std::span<const Kind* const> kinds, std::string_view pointer) {
  std::vector<Table> tables;
  for (const Kind* kind : kinds) {
    // A model's own settings have a section with the model's name.
    std::string place(pointer);
    if constexpr (std::is_same_v<Kind, BendingKind>) place += "/" + std::string(kind->name);
    tables.push_back({std::string(kind->name), std::move(place), std::string(kind->summary), kind->settings});
  }
  return tables;
}

std::vector<Table> parts() {
  std::vector<Table> tables = {{"", "", "What a simulation is made from", scene_table()}};
  for (const Part& part : scene_parts()) {
    const std::size_t slash = part.pointer.rfind('/');
    tables.push_back({std::string(part.pointer.substr(slash + 1)), std::string(part.pointer),
                      std::string(part.meaning), part.table});
  }
  return tables;
}

// scene.py has checked the arrays: (V, 3) and (T, 3).
std::optional<TriangleMesh> mesh_of(const py::object& vertices, const py::object& triangles) {
  if (vertices.is_none()) return std::nullopt;
  using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
  using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
  const auto x = Numbers::ensure(vertices);
  const auto t = Indices::ensure(triangles);
  TriangleMesh mesh;
  mesh.positions = Eigen::Map<const Positions>(x.data(), x.shape(0), 3);
  mesh.triangles.resize(t.shape(0), 3);
  for (py::ssize_t i = 0; i < t.shape(0); ++i)
    for (py::ssize_t c = 0; c < 3; ++c) mesh.triangles(i, c) = static_cast<int>(t.at(i, c));
  return mesh;
}

py::list problems_of(const ConfigError& error) {
  py::list problems;
  for (const ConfigProblem& problem : error.problems())
    problems.append(py::make_tuple(problem.pointer, problem.message));
  return problems;
}

}  // namespace
}  // namespace bendlab

PYBIND11_MODULE(_core, module) {
  using namespace bendlab;
  using namespace py::literals;
  static py::exception<ConfigError> config_error(module, "ConfigError", PyExc_ValueError);
  static py::exception<MeshError> mesh_error(module, "MeshError", PyExc_ValueError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const ConfigError& error) {
      const py::object type = py::reinterpret_borrow<py::object>(config_error.ptr());
      py::object raised = type(error.what());
      raised.attr("problems") = problems_of(error);
      PyErr_SetObject(type.ptr(), raised.ptr());
    } catch (const MeshError& error) {
      PyErr_SetString(mesh_error.ptr(), error.what());
    } catch (const MeshFileError& error) {
      PyErr_SetString(mesh_error.ptr(), error.what());
    }
  });

  py::class_<Table>(module, "Table")
      .def_readonly("name", &Table::name)
      .def_readonly("pointer", &Table::pointer)
      .def_readonly("meaning", &Table::meaning)
      .def("fields", &Table::fields)
      .def("read", &Table::read, "setting"_a, "json"_a);
  module.def("parts", &parts);
  module.def("models", [] { return tables_of(bending_models(), "/bending"); });
  module.def("effects", [] { return tables_of(effects(), "/effects"); });
  module.def("methods", [] { return tables_of(methods(), "/solver"); });

  py::class_<PythonCloth>(module, "Cloth")
      .def(py::init([](const std::string& scene, const std::string& folder, const py::object& vertices,
                       const py::object& triangles) {
             std::optional<TriangleMesh> mesh = mesh_of(vertices, triangles);
             const RegistryReader reader;
             const py::gil_scoped_release without_gil;
             return std::make_unique<PythonCloth>(scene, folder, std::move(mesh));
           }),
           "scene"_a, "folder"_a = "", "vertices"_a = py::none(), "triangles"_a = py::none())
      .def("step", &PythonCloth::step, "One time step, Solver.dt.")
      .def("run", &PythonCloth::run, "seconds"_a, "progress"_a = py::none())
      .def_property_readonly("time", &PythonCloth::time, "Simulated time, s.")
      .def_property_readonly(
          "settled", &PythonCloth::settled,
          "Whether further steps would change nothing; always False for methods that simulate motion.")
      .def_property_readonly("positions", &PythonCloth::positions,
                             "(V, 3), m. A read-only view. The numbers change when positions are read again: "
                             "use copy() to store the numbers.")
      .def_property_readonly("velocities", &PythonCloth::velocities, "(V, 3), m/s. A view like positions.")
      .def_property_readonly("triangles", &PythonCloth::triangles, "(T, 3), vertices of each triangle.")
      .def_property_readonly("masses", &PythonCloth::masses, "(V), kg. Pinned vertices have a mass, too.")
      .def_property_readonly("pinned", &PythonCloth::pinned, "(P), the vertices that are pinned.")
      .def_property_readonly("pins", &PythonCloth::pins)
      .def_property_readonly("warnings", &PythonCloth::warnings,
                             "(code, text) of each warning about the scene, as `bendlab run` prints it.")
      .def("energies", &PythonCloth::energies,
           "Energies, J: kinetic, the potential energy of the weight (0 at the start), strain, and each kind "
           "of bending constraint. Constraints whose stiffness is given as k have no energy.")
      .def("forces", &PythonCloth::forces, "(V, 3), N, by kind of constraint; 0 at pinned vertices.");
  add_own_parts(module);
  add_runs(module);
}
