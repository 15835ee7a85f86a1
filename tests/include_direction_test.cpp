// Includes go one way: mesh <- constraints <- {bending, effects, solver} <- experiments; metrics sees mesh;
// io sees no other room; parameters are seen by all. CGAL stays in the mesh room's sources, HDF5 in io.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "tests/catch.hpp"

namespace {

namespace fs = std::filesystem;

const fs::path library = fs::path(BENDLAB_SOURCE_DIR) / "lib" / "bendlab";

/// Each room and the rooms it may include besides itself.
const std::map<std::string, std::set<std::string>> allowed = {
    {"parameters", {}},
    {"mesh", {"parameters"}},
    {"constraints", {"parameters", "mesh"}},
    {"bending", {"parameters", "mesh", "constraints"}},
    {"effects", {"parameters", "mesh", "constraints"}},
    {"solver", {"parameters", "mesh", "constraints"}},
    {"metrics", {"parameters", "mesh"}},
    {"io", {"parameters"}},
};

/// What the #include lines of a file name.
std::vector<std::string> includes_of(const fs::path& file) {
  static const std::regex pattern(R"(^\s*#\s*include\s*["<]([^">]+)[">])");
  std::vector<std::string> names;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (std::smatch match; std::regex_search(line, match, pattern)) names.push_back(match[1]);
  return names;
}

std::vector<fs::path> sources_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".hpp" || extension == ".cpp" || extension == ".def") files.push_back(entry.path());
  }
  return files;
}

TEST_CASE("Every room of the library is known to the include test", "[layout]") {
  std::set<std::string> rooms, known;
  for (const auto& entry : fs::directory_iterator(library))
    if (entry.is_directory()) rooms.insert(entry.path().filename().string());
  for (const auto& [room, others] : allowed) known.insert(room);
  CHECK(rooms == known);
}

TEST_CASE("Includes of the library go one way", "[layout]") {
  for (const auto& [room, others] : allowed) {
    const std::vector<fs::path> files = sources_in(library / room);
    INFO("room " << room);
    REQUIRE_FALSE(files.empty());
    for (const fs::path& file : files) {
      for (const std::string& name : includes_of(file)) {
        INFO(file.string() << " includes " << name);
        CHECK_FALSE(name.starts_with("experiments/"));
        CHECK_FALSE(name.starts_with("tests/"));
        CHECK_FALSE(name.starts_with(".."));  // would slip past this test
        if (!name.starts_with("bendlab/")) continue;
        const std::string other = name.substr(8, name.find('/', 8) - 8);
        CHECK((other == room || others.contains(other)));
      }
    }
  }
}

TEST_CASE("CGAL stays in the sources of the mesh room and HDF5 in io", "[layout]") {
  for (const char* folder : {"lib/bendlab", "experiments"}) {
    for (const fs::path& file : sources_in(fs::path(BENDLAB_SOURCE_DIR) / folder)) {
      for (const std::string& name : includes_of(file)) {
        INFO(file.string() << " includes " << name);
        const bool in_mesh_source = file.extension() == ".cpp" && file.parent_path() == library / "mesh";
        if (name.starts_with("CGAL/")) CHECK(in_mesh_source);
        if (name.starts_with("hdf5") || name.starts_with("H5")) CHECK(file.parent_path() == library / "io");
      }
    }
  }
}

}  // namespace
