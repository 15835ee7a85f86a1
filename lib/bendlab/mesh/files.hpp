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
    refused,     ///< the file holds no mesh that can be simulated (exit code 4)
  };
  MeshFileError(Kind kind, const std::string& text) : std::runtime_error(text), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// The extension of a file with its dot, in lower case.
std::string extension_of(const std::filesystem::path& path);

/// Reads a file in the format of its extension (.obj, .ply, .off, .stl; upper or lower case), as text or
/// binary. Polygons with more than three corners are cut into triangles (cut_polygon.hpp). The soup of an OBJ
/// file has texture coordinates if the file has texture coordinates for all corners. STL files have no
/// indices, so exactly equal points become one vertex. Vertices and indices are not checked. Throws
/// MeshFileError.
PolygonSoup read_polygon_soup(const std::filesystem::path& path);

/// Like read_polygon_soup(), for a file whose bytes are already in memory.
PolygonSoup parse_polygon_soup(const std::filesystem::path& path, const std::string& bytes);

/// Reads a mesh that can be simulated. `policy` says what to do about problems of the mesh
/// (bad_triangles.hpp). Throws MeshFileError with every problem that the policy refuses.
AcceptedMesh read_mesh(const std::filesystem::path& path, BadTriangles policy);

/// Reads a mesh with the policy `refuse`, where no config sets a policy. Isolated vertices are left out;
/// warnings about them are appended to `notes` if it is not null.
TriangleMesh read_mesh(const std::filesystem::path& path, std::vector<std::string>* notes = nullptr);

/// Writes .obj (with texture coordinates), .ply or .off as text, without rounding. Throws MeshFileError.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace bendlab
