// `bendlab mesh`: checks a mesh file, and prints the quality of its triangles.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/files.hpp"
#include "bendlab/scene/counted.hpp"
#include "bendlab/scene/json_text.hpp"
#include "bendlab/settings/names.hpp"
#include "experiments/cli/command.hpp"
#include "experiments/cli/mesh_report.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

// What each of the other policies would do with a mesh file that was refused.
std::string policies_text(const fs::path& file) try {
  const PolygonSoup soup = read_polygon_soup(file);
  if (soup.triangles.empty()) return "";
  std::string text = "\nother choices of /mesh/bad_triangles (here: --bad-triangles) would";
  for (std::size_t p = 1; p < bad_triangles_names.size(); ++p) try {
      const AcceptedMesh accepted = accept(soup, static_cast<BadTriangles>(p));
      text += fmt::format("\n  {}: take it with {} vertices and {}\n    {}", bad_triangles_names[p],
                          accepted.mesh.vertex_count(), counted(accepted.mesh.triangle_count(), "triangle"),
                          fmt::join(accepted.notes, "\n    "));
    } catch (const std::invalid_argument&) {
      text += fmt::format("\n  {}: refuse it too", bad_triangles_names[p]);
    }
  return text;
} catch (const MeshFileError&) {  // no policy can read the file
  return "";
}

struct MeshCommand : Command {
  fs::path file, write;
  std::string policy = "refuse";
  QualityThresholds thresholds;

  MeshCommand() {
    add(file, "FILE", "Mesh: .obj, .ply, .off or .stl");
    add(policy, fmt::format("--bad-triangles {}", fmt::join(bad_triangles_names, "|")),
        "What to do with a bad mesh: a value of the setting /mesh/bad_triangles");
    add(write, "--write FILE", "Write the accepted mesh to this file (.obj, .ply or .off)");
    add(thresholds.needle_ratio, "--needle-ratio",
        "A triangle is a needle if its longest edge is at least this many times as long as its shortest "
        "edge",
        {1, 1e9});
    add(thresholds.cap_angle, "--cap-angle",
        "A triangle is a cap if one of its angles is at least this many degrees", {90, 180});
    add(thresholds.small_angle, "--small-angle", "An angle is small if it is below this many degrees",
        {0, 60});
    add(json, "--json", "Print one JSON object");
  }

  int run() override {
    const auto chosen = named<BadTriangles>(policy, bad_triangles_names);
    AcceptedMesh accepted;
    try {
      accepted = read_mesh(file, chosen);
    } catch (const MeshFileError& error) {
      if (error.kind() != MeshFileError::Kind::refused) throw;
      throw MeshFileError(error.kind(), error.what() + policies_text(file));
    }
    for (const std::string& note : accepted.notes) print_text(stderr, "bendlab: {}\n", note);
    if (!write.empty()) write_mesh(write, accepted.mesh);
    if (json) {
      nlohmann::ordered_json report = mesh_report_json(accepted.mesh, file.string(), thresholds);
      report["bad_triangles"] = policy;
      report["notes"] = accepted.notes;
      print_text("{}\n", json_text(report));
    } else {
      print_text("{}", mesh_report(accepted.mesh, file.string(), thresholds));
    }
    return exit_ok;
  }
};

}  // namespace

extern const CommandKind mesh_command{"mesh", "Check a mesh file and print the quality of its triangles",
                                      "bendlab mesh garment.obj --bad-triangles repair", make<MeshCommand>};

}  // namespace bendlab
