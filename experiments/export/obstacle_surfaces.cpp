#include "experiments/export/obstacle_surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "bendlab/scene/built_scene.hpp"

namespace bendlab {
namespace {

// The bytes of the file that an effect names, as the run file has them; null if it names none. Throws
// std::invalid_argument if the run file lacks it.
const std::string* file_of(const Effect& effect, std::size_t index, const std::vector<InputFile>& inputs) {
  for (const Field& field : effect.kind().settings.fields) {
    if (!field.names_file) continue;
    const auto file =
        std::ranges::find(inputs, fmt::format("/effects/{}/{}", index, field.name), &InputFile::pointer);
    if (file == inputs.end())
      throw std::invalid_argument(fmt::format("the run file does not hold its {}", field.name));
    return &file->bytes;
  }
  return nullptr;
}

}  // namespace

std::vector<Surface> obstacle_surfaces(const std::vector<Effect>& effects,
                                       const std::vector<InputFile>& inputs, const Vector3& centre,
                                       double size, std::vector<std::string>& notes) {
  std::vector<Surface> surfaces;
  for (std::size_t index = 0; index < effects.size(); ++index) {
    const Effect& effect = effects[index];
    if (effect.kind().surface == nullptr) continue;
    Surface surface{.name = pass_name(effects, index)};
    std::ranges::replace(surface.name, ' ', '_');
    try {
      ObstacleSurface made = effect.kind().surface(
          effect.settings(), {.file = file_of(effect, index, inputs), .centre = centre, .size = size});
      surface.positions = std::move(made.mesh.positions);
      surface.triangles = std::move(made.mesh.triangles);
      surface.velocity = made.velocity;
    } catch (const std::exception& error) {
      notes.push_back(fmt::format("{} is left out: {}", surface.name, error.what()));
      continue;
    }
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

}  // namespace bendlab
