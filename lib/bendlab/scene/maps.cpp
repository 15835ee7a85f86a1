#include "bendlab/scene/maps.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "bendlab/mesh/files.hpp"
#include "bendlab/mesh/surface_values.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {
namespace {

// A triangle is sampled at its centre and at the middles of its edges, so that a map's details between the
// centres count, too.
constexpr std::array<std::array<double, 3>, 4> map_samples = {
    {{1. / 3, 1. / 3, 1. / 3}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}}};

[[noreturn]] void refuse_map(const std::string& pointer, const std::string& why) {
  throw ConfigError("map", {{pointer, why}});
}

// #T: the mean over the samples of a triangle. `value`: (triangle, weights of its corners) → number.
template <class Value>
std::vector<double> means(const RestMesh& rest, const Value& value) {
  std::vector<double> result;
  for (int t = 0; t < rest.triangle_count(); ++t) {
    double sum = 0;
    for (const std::array<double, 3>& weights : map_samples)
      sum += value(t, weights) / static_cast<double>(map_samples.size());
    result.push_back(sum);
  }
  return result;
}

// #T: the value of a PLY property. Vertices are moved back to where they are in the mesh file.
std::vector<double> values_of_property(const MaterialMap& map, const Mesh& mesh, const RestMesh& rest,
                                       const std::filesystem::path& folder, const std::string& pointer) {
  const SurfaceValues values(folder / *map.file, map.property);
  const Positions& named = rest.named_positions();
  const auto in_file = [&](int v) -> Vector3 {
    return (named.row(v).transpose() - mesh.offset) / mesh.scale;
  };
  double farthest = 0;
  int where = 0;
  std::vector<double> result = means(rest, [&](int t, const std::array<double, 3>& weights) {
    Vector3 place = Vector3::Zero();
    for (int c = 0; c < 3; ++c)
      place += weights[static_cast<std::size_t>(c)] * in_file(rest.triangles()(t, c));
    const SurfaceValues::At at = values(place);
    if (at.distance > farthest) farthest = at.distance, where = t;
    return at.value;
  });
  const double allowed = 0.1 * rest.mean_edge_length() / mesh.scale;
  if (farthest > allowed)
    refuse_map(
        pointer + "/file",
        fmt::format(
            "the map belongs to another mesh: triangle {} is {:.3g} away from the surface in {}, in the "
            "file's unit of length. Paint the map on the mesh of /mesh/file, or move it there",
            where, farthest, *map.file));
  return result;
}

// #T: the grey of an image. Without texture coordinates, the image covers the box of a flat sheet.
std::vector<double> values_of_image(const MaterialMap& map, const RestMesh& rest,
                                    const std::filesystem::path& folder, const std::string& pointer) {
  const GreyImage image(folder / *map.file);
  const TextureCoordinates& texture = rest.mesh().texture_coordinates;
  const bool textured = texture.rows() == 3 * rest.triangle_count();
  const Positions& named = rest.named_positions();
  const Vector3 low = named.colwise().minCoeff(), extent = named.colwise().maxCoeff().transpose() - low;
  if (!textured && !(extent.z() <= 1e-6 * extent.norm()))
    refuse_map(pointer + "/file",
               "an image needs texture coordinates, which this mesh does not have: use an OBJ file "
               "with texture coordinates, a PLY file with a property, or a sheet in the x-y plane");
  const auto coordinate = [&](int t, int c) -> Vector2 {
    if (textured) return texture.row(3 * t + c).transpose();
    const auto p = named.row(rest.triangles()(t, c));
    return {(p(0) - low(0)) / extent(0), (p(1) - low(1)) / extent(1)};
  };
  return means(rest, [&](int t, const std::array<double, 3>& weights) {
    Vector2 at = Vector2::Zero();
    for (int c = 0; c < 3; ++c) at += weights[static_cast<std::size_t>(c)] * coordinate(t, c);
    return image(at);
  });
}

}  // namespace

std::vector<double> factors_of(const MaterialMap& map, const Mesh& mesh, const RestMesh& rest,
                               const std::filesystem::path& folder, const std::string& pointer) {
  if (!map.file) return {};
  std::vector<double> factors;
  const std::string extension = extension_of(*map.file);
  if (extension == ".ply") {
    if (map.property.empty())
      refuse_map(pointer + "/property", "is missing: name the property of the PLY file that holds the map");
    factors = values_of_property(map, mesh, rest, folder, pointer);
  } else if (extension == ".png") {
    if (!map.property.empty())
      refuse_map(pointer + "/property",
                 "is not read from a PNG image: remove this setting or name a PLY file");
    factors = values_of_image(map, rest, folder, pointer);
  } else {
    refuse_map(pointer + "/file", fmt::format("'{}' is neither a PLY file nor a PNG image", *map.file));
  }
  for (std::size_t t = 0; t < factors.size(); ++t) {
    factors[t] = map.low + (map.high - map.low) * factors[t];
    if (!(factors[t] > 0) || !std::isfinite(factors[t]))
      refuse_map(
          pointer,
          fmt::format("the factor of triangle {} is {:.4g}, but factors have to be above 0: set `low`, "
                      "the factor of the value 0, to 0.01, for example",
                      t, factors[t]));
  }
  return factors;
}

}  // namespace bendlab
