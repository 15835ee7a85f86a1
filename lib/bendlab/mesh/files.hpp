// Mesh files: OBJ, PLY, OFF, STL.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/soup.hpp"
#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// A mesh file can't be used. The text says which file, why, and what to do.
class MeshFileError : public std::runtime_error {
 public:
  enum class Kind {
    unreadable,  ///< the file can't be opened, read or written (exit code 5)
    refused,     ///< its content is no mesh that can be simulated (exit code 4)
  };
  MeshFileError(Kind kind, const std::string& text) : std::runtime_error(text), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// Reads a file by its extension (.obj, .ply, .off, .stl; upper or lower case), in text or binary form as far
/// as the format has them. Polygons with more than three corners are cut into triangles (cut_polygon.hpp).
/// OBJ: with texture coordinates if every corner has one. STL has no indices: exactly equal
/// points become one vertex. Vertices and indices are not checked. Throws MeshFileError.
PolygonSoup read_polygon_soup(const std::filesystem::path& path);

/// The same of a file's bytes; `path` is its name.
PolygonSoup parse_polygon_soup(const std::filesystem::path& path, const std::string& bytes);

/// A mesh that can be simulated, by the policy of bad_triangles.hpp. Throws MeshFileError with every problem
/// that the policy refuses.
AcceptedMesh read_mesh(const std::filesystem::path& path, BadTriangles policy);

/// Refuses a mesh in which diagnose() finds problems, but leaves out isolated vertices: for meshes that no
/// config has a policy for. `notes`, if given, receives what was left out.
TriangleMesh read_mesh(const std::filesystem::path& path, std::vector<std::string>* notes = nullptr);

/// Writes .obj (with texture coordinates), .ply or .off as text that reads back to the same numbers. Throws
/// MeshFileError.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace bendlab
