#include "own_parts.hpp"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bendlab/bending/rest_hinges.hpp"
#include "bendlab/effects/effects.hpp"
#include "bendlab/scene/fields_json.hpp"
#include "experiments/measures/measure.hpp"
#include "readers.hpp"
#include "values.hpp"

namespace py = pybind11;

namespace bendlab {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<int, py::array::c_style | py::array::forcecast>;

// What the program knows about a Python class. An OwnPart is never freed, because scenes refer to it.
struct OwnPart {
  py::object type;  // the class
  std::string name, label, summary, source, code;
  std::vector<std::string> texts;  // the fields refer to these texts
  std::vector<Field> fields;
};

// The settings of an object of a Python class: values by name.
struct OwnSettings {
  const OwnPart* part = nullptr;
  std::map<std::string, Value, std::less<>> values;

  // Makes the Python object. The caller must hold the GIL.
  py::object made() const {
    py::dict given;
    for (const auto& [name, value] : values) given[py::str(name)] = python_of(value);
    return part->type(**given);
  }
};

std::string_view store(OwnPart& part, const py::handle& text) {
  return part.texts.emplace_back(py::cast<std::string>(text));
}

FieldType type_of(const std::string& name) {
  static const std::map<std::string, FieldType> types = {{"bool", FieldType::boolean},
                                                         {"int", FieldType::integer},
                                                         {"float", FieldType::number},
                                                         {"str", FieldType::text},
                                                         {"list", FieldType::numbers}};
  return types.at(name);
}

// A row for each of {name, unit, meaning, type, default, minimum, maximum, above}.
FieldTable table_of(OwnPart& part, const py::list& rows) {
  auto* const usual = new OwnSettings{&part, {}};
  part.texts.reserve(3 * rows.size());
  for (const py::handle& listed : rows) {
    const auto row = py::cast<py::dict>(listed);
    Field field;
    field.name = store(part, row["name"]), field.unit = store(part, row["unit"]);
    field.meaning = store(part, row["meaning"]);
    field.type = type_of(py::cast<std::string>(row["type"]));
    field.minimum = py::cast<double>(row["minimum"]), field.maximum = py::cast<double>(row["maximum"]);
    field.above = py::cast<bool>(row["above"]);
    field.place = [](const void* owner) { return owner; };
    field.get = [](const Field& own, const void* owner) {
      return static_cast<const OwnSettings*>(owner)->values.find(own.name)->second;
    };
    field.set = [](const Field& own, void* owner, const Value& value) {
      Value& at = static_cast<OwnSettings*>(owner)->values.find(own.name)->second;
      const auto* whole = std::get_if<std::int64_t>(&value);
      at = whole != nullptr && own.type == FieldType::number ? Value(static_cast<double>(*whole)) : value;
    };
    usual->values.emplace(std::string(field.name), value_of(field.type, row["default"]));
    part.fields.push_back(field);
  }
  return {part.fields, [](const void* own) { return own; },
          [](const void* owner) -> std::shared_ptr<void> {
            return std::make_shared<OwnSettings>(*static_cast<const OwnSettings*>(owner));
          },
          usual};
}

OwnPart& new_part(const py::object& type, const py::dict& about) {
  RegistryReader::require_none();
  auto* const part = new OwnPart{type, {}, {}, {}, {}, {}, {}, {}};
  part->name = py::cast<std::string>(about["name"]), part->label = py::cast<std::string>(about["label"]);
  part->summary = py::cast<std::string>(about["summary"]);
  part->source = py::cast<std::string>(about["source"]), part->code = py::cast<std::string>(about["code"]);
  return *part;
}

// ---- bending models

class PythonFunction final : public ElementFunction {
 public:
  PythonFunction(std::string name, py::object evaluate, bool is_energy)
      : name_(std::move(name)), evaluate_(std::move(evaluate)), is_energy_(is_energy) {}
  ~PythonFunction() override {
    const py::gil_scoped_acquire gil;
    evaluate_.release().dec_ref();
  }
  PythonFunction(const PythonFunction&) = delete;
  PythonFunction& operator=(const PythonFunction&) = delete;

  std::string_view name() const override { return name_; }
  bool is_energy() const override { return is_energy_; }
  void evaluate(std::span<const int> which, std::span<const double> corners, std::span<double> values,
                std::span<double> gradients) const override {
    if (which.empty()) return;
    const py::gil_scoped_acquire gil;
    const auto count = static_cast<py::ssize_t>(which.size());
    const auto arity = static_cast<py::ssize_t>(corners.size()) / count / 3;
    const py::array_t<double> x({count, arity, py::ssize_t{3}}, corners.data());
    const py::array_t<int> elements(count, which.data());
    const py::tuple result = evaluate_(elements, x);  // of the right shapes: own.py checks them
    std::ranges::copy_n(py::cast<Numbers>(result[0]).data(), count, values.begin());
    std::ranges::copy_n(py::cast<Numbers>(result[1]).data(), 3 * count * arity, gradients.begin());
  }

 private:
  std::string name_;
  py::object evaluate_;
  bool is_energy_;
};

py::array_t<int> hinges_of(const RestMesh& rest, const Pins& pins) {
  const std::vector<RestHinge> hinges = rest_hinges(rest, pins);
  py::array_t<int> rows({static_cast<py::ssize_t>(hinges.size()), py::ssize_t{4}});
  auto row = rows.mutable_unchecked<2>();
  for (std::size_t h = 0; h < hinges.size(); ++h)
    for (std::size_t i = 0; i < 4; ++i)
      row(static_cast<py::ssize_t>(h), static_cast<py::ssize_t>(i)) = hinges[h].vertices[i];
  return rows;
}

py::dict rest_of(const RestMesh& rest, const Pins& pins) {
  using namespace py::literals;
  std::vector<bool> pinned(static_cast<std::size_t>(rest.vertex_count()));
  for (int v = 0; v < rest.vertex_count(); ++v) pinned[static_cast<std::size_t>(v)] = pins.pinned(v);
  return py::dict("positions"_a = rest.positions(), "triangles"_a = rest.triangles(),
                  "pinned"_a = py::array(py::cast(pinned)), "hinges"_a = hinges_of(rest, pins),
                  "areas"_a = py::array(py::cast(rest.areas())));
}

// The result of a model's elements() in Python, checked by own.py: (vertices, softness, evaluate, is_energy).
OwnElements elements_of(const std::string& name, const py::tuple& made) {
  const auto vertices = py::cast<Indices>(made[0]);
  const auto softness = py::cast<Numbers>(made[1]);
  OwnElements own;
  own.arity = static_cast<std::size_t>(vertices.shape(1));
  own.vertices.assign(vertices.data(), vertices.data() + vertices.size());
  own.softness.assign(softness.data(), softness.data() + softness.size());
  own.function = std::make_shared<PythonFunction>(name, made[2], py::cast<bool>(made[3]));
  return own;
}

BendingConstraints build(const OwnSettings& settings, const BendingInput& input) {
  const py::gil_scoped_acquire gil;
  const py::object build = py::module_::import("bendlab.own").attr("build_elements");
  BendingConstraints constraints;
  constraints.own = elements_of(settings.part->name, build(settings.made(), rest_of(input.rest, input.pins)));
  return constraints;
}

void register_model(const py::object& type, const py::dict& about, const py::list& fields) {
  OwnPart& part = new_part(type, about);
  auto* const kind = new BendingKind;
  kind->name = part.name, kind->label = part.label, kind->summary = part.summary, kind->source = part.source;
  kind->compliance = "the softness of its elements";
  kind->settings = table_of(part, fields);
  kind->softness_needs_compliance = true;
  kind->build = erased<build>;
  kind->code = part.code;
  remove_bending_model(part.name);
  register_bending_model(*kind);
}

// ---- effects

// The Python object of an effect, and the order of the vertices in State's arrays.
struct ActingEffect {
  py::object object;
  std::vector<std::size_t> slot;  // #V: index of each vertex in State's arrays

  ~ActingEffect() {
    const py::gil_scoped_acquire gil;
    object.release().dec_ref();
  }

  template <class Real, class PointOf>
  py::array_t<double> rows(const State<Real>&, const PointOf& point) const {
    py::array_t<double> all({static_cast<py::ssize_t>(slot.size()), py::ssize_t{3}});
    double* next = all.mutable_data();
    for (const std::size_t v : slot) {
      const Vector3 p = point(v);
      next = std::copy_n(p.data(), 3, next);
    }
    return all;
  }
};

template <class Real>
std::vector<Pass<Real>> compile(const OwnSettings& settings, const EffectInput& input) {
  const py::gil_scoped_acquire gil;
  const auto acting = std::make_shared<ActingEffect>();
  acting->object = settings.made();
  for (int v = 0; v < input.rest.vertex_count(); ++v) acting->slot.push_back(input.permuted(v));
  return {{settings.part->name, Stage::force, [acting](PassContext<Real>& context) {
             State<Real>& state = context.state;
             const py::gil_scoped_acquire holding;
             const auto x = acting->rows(state, [&](std::size_t v) {
               return Vector3(state.position[v].vector().template cast<double>() + state.origin);
             });
             const auto velocity = acting->rows(state, [&](std::size_t v) {
               return Vector3(state.velocity[v].vector().template cast<double>());
             });
             const auto acceleration =
                 py::cast<Numbers>(py::module_::import("bendlab.own")
                                       .attr("acceleration_of")(acting->object, x, velocity, context.time,
                                                                py::cast(state.mass)));
             const double* row = acceleration.data();
             for (const std::size_t v : acting->slot) {
               const Vector3 change = static_cast<double>(context.substep) * Eigen::Map<const Vector3>(row);
               if (state.position[v].w > 0) state.accelerate(v, change.template cast<Real>());
               row += 3;
             }
             context.acted += acting->slot.size();
           }}};
}

void register_own_effect(const py::object& type, const py::dict& about, const py::list& fields) {
  OwnPart& part = new_part(type, about);
  auto* const kind = new EffectKind;
  kind->name = part.name, kind->summary = part.summary, kind->source = part.source;
  kind->settings = table_of(part, fields);
  kind->force_follows_pose = true;
  kind->damps = py::cast<bool>(about["damps"]);
  kind->keeps_momentum = py::cast<bool>(about["keeps_momentum"]);
  kind->compile_float = erased<compile<float>>, kind->compile_double = erased<compile<double>>;
  if (!kind->damps) kind->drives = [](const void*) { return true; };
  kind->code = part.code;
  remove_effect(part.name);
  register_effect(*kind);
}

// ---- measures

std::vector<Column> columns_of(const py::list& rows) {
  std::vector<Column> columns;
  for (const py::handle& row : rows) {
    const auto texts = py::cast<std::array<std::string, 3>>(row);
    columns.push_back({texts[0], texts[1], texts[2]});
  }
  return columns;
}

class PythonMeasurement final : public Measurement {
 public:
  PythonMeasurement(const OwnPart& part, const BuiltScene& scene, std::size_t columns,
                    std::vector<Column> gives)
      : columns_(columns), gives_(std::move(gives)) {
    const py::gil_scoped_acquire gil;
    object_ = part.type();
    using namespace py::literals;
    py::dict rest = rest_of(scene.rest, scene.pins);
    rest["masses"] = py::array(py::cast(scene.input.mass));
    py::module_::import("bendlab.own").attr("begin_measure")(object_, rest);
  }
  ~PythonMeasurement() override {
    const py::gil_scoped_acquire gil;
    object_.release().dec_ref();
  }
  PythonMeasurement(const PythonMeasurement&) = delete;
  PythonMeasurement& operator=(const PythonMeasurement&) = delete;

  void complete(const MeasuredFrame& frame, std::span<double> values,
                std::span<std::vector<float>>) override {
    if (columns_ == 0) return;
    const py::gil_scoped_acquire gil;
    const auto metrics = py::cast<std::vector<double>>(
        py::module_::import("bendlab.own").attr("measured_frame")(object_, frame.positions(), frame.time()));
    std::ranges::copy(metrics, values.begin());
  }
  void finish(const RunEnd& end, Findings& findings) override {
    if (gives_.empty()) return;
    const py::gil_scoped_acquire gil;
    const auto metrics = py::cast<std::vector<std::optional<double>>>(
        py::module_::import("bendlab.own").attr("measured_end")(object_, end.simulation.positions()));
    for (std::size_t i = 0; i < gives_.size(); ++i)
      if (metrics[i]) findings.summary[gives_[i].name] = *metrics[i];
  }
  void archive(Archive& state) override {
    const py::gil_scoped_acquire gil;
    const py::object pickle = py::module_::import("pickle");
    std::string bytes = py::cast<std::string>(pickle.attr("dumps")(object_.attr("__dict__")));
    state(bytes);
    if (state.reads()) object_.attr("__dict__").attr("update")(pickle.attr("loads")(py::bytes(bytes)));
  }

 private:
  py::object object_;
  std::size_t columns_;
  std::vector<Column> gives_;
};

void register_own_measure(const py::object& type, const py::dict& about, const py::list& columns,
                          const py::list& numbers) {
  OwnPart& part = new_part(type, about);
  const std::vector<Column> of_frames = columns_of(columns), of_run = columns_of(numbers);
  auto* const measure = new Measure;
  measure->name = part.name, measure->summary = part.summary, measure->cost = "a call to Python per frame";
  measure->code = part.code;
  measure->columns = [of_frames] { return of_frames; };
  measure->gives = [of_run] { return of_run; };
  measure->begin = [&part, of_frames, of_run](const RunConfig&, const BuiltScene& scene) {
    return std::make_unique<PythonMeasurement>(part, scene, of_frames.size(), of_run);
  };
  remove_measure(part.name);
  register_measure(*measure);
}

}  // namespace

void add_own_parts(py::module_& module) {
  using namespace py::literals;
  module.def("register_model", &register_model, "type"_a, "about"_a, "fields"_a);
  module.def(
      "remove_model", [](const std::string& name) { remove_bending_model(name); }, "name"_a);
  module.def("register_effect", &register_own_effect, "type"_a, "about"_a, "fields"_a);
  module.def("register_measure", &register_own_measure, "type"_a, "about"_a, "columns"_a, "numbers"_a);
  // The arrays that a model gets for a mesh. own.py checks gradients with them.
  module.def("rest_of", [](const Positions& vertices, const Triangles& triangles) {
    const RestMesh rest(TriangleMesh{vertices, triangles});
    return rest_of(rest, make_pins(rest, {}, 0));
  });
}

}  // namespace bendlab
