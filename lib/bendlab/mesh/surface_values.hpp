// Values on a surface that a file states: a property of a PLY file, or the grey of a PNG image.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// A property of the points or faces of a PLY file, as a function of the place.
class SurfaceValues {
 public:
  /// Throws MeshFileError if the file cannot be read or has no such property.
  SurfaceValues(const std::filesystem::path& file, std::string_view property);
  ~SurfaceValues();
  SurfaceValues(const SurfaceValues&) = delete;
  SurfaceValues& operator=(const SurfaceValues&) = delete;

  struct At {
    double value;
    double distance;  ///< from the place to the surface, in the file's unit of length
  };
  /// The value at the point of the surface that is nearest to `place`: linear between points, constant on
  /// faces.
  At operator()(const Vector3& place) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// The grey of an image, as a function of texture coordinates: (0, 0) is the lower left corner, and the image
/// repeats beyond (1, 1).
class GreyImage {
 public:
  /// Reads a PNG file; colours become their luminance, and transparency is ignored. Throws MeshFileError.
  explicit GreyImage(const std::filesystem::path& file);

  /// From 0 (black) to 1 (white), linear between the centres of pixels.
  double operator()(const Vector2& texture) const;

 private:
  int width_ = 0, height_ = 0;
  std::vector<float> grey_;  // row by row from the top
};

}  // namespace bendlab
