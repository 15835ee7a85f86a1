// Includes go one way, in the library and above it in the experiments. CGAL stays in the mesh room's sources,
// HDF5 in io.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/catch.hpp"
#include "tests/places.hpp"

namespace {

namespace fs = std::filesystem;

const fs::path library = fs::path(bendlab::places::source) / "lib" / "bendlab",
               experiments = fs::path(bendlab::places::source) / "experiments";

/// Each room and the rooms it may include besides itself.
using Rooms = std::map<std::string, std::set<std::string>>;
const Rooms library_rooms = {
    {"parameters", {}},
    {"mesh", {"parameters"}},
    {"constraints", {"parameters", "mesh"}},
    {"bending", {"parameters", "mesh", "constraints"}},
    {"effects", {"parameters", "mesh", "constraints"}},
    {"solver", {"parameters", "mesh", "constraints"}},
    {"metrics", {"parameters", "mesh"}},
    {"io", {"parameters"}},
    {"scene", {"parameters", "mesh", "constraints", "bending", "effects", "solver", "metrics"}},
};
/// In the order of experiments/README.md; each sees the library besides.
const std::vector<std::pair<std::string, std::set<std::string>>> experiment_rooms = {
    {"config", {}},
    {"measures", {"config"}},
    {"run", {"config", "measures"}},
    {"terminal", {}},
    {"campaign", {"config", "measures", "run", "terminal"}},
    {"export", {"config", "measures", "run"}},
    {"advise", {"config", "measures", "run", "terminal", "campaign"}},
    {"bench", {"config", "measures", "run", "terminal", "campaign"}},
    {"cli", {"config", "measures", "run", "terminal", "campaign", "export", "advise", "bench"}},
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

void check_rooms(const Rooms& rooms, const fs::path& folder, const std::string& prefix) {
  std::set<std::string> found, known;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory()) found.insert(entry.path().filename().string());
  for (const auto& [room, others] : rooms) known.insert(room);
  CHECK(found == known);
  for (const auto& [room, others] : rooms) {
    const std::vector<fs::path> files = sources_in(folder / room);
    INFO("room " << room);
    REQUIRE_FALSE(files.empty());
    for (const fs::path& file : files)
      for (const std::string& name : includes_of(file)) {
        INFO(file.string() << " includes " << name);
        CHECK_FALSE(name.starts_with("tests/"));
        CHECK_FALSE(name.starts_with(".."));  // would slip past this test
        if (prefix == "bendlab/") CHECK_FALSE(name.starts_with("experiments/"));
        if (!name.starts_with(prefix)) continue;
        const std::string other = name.substr(prefix.size(), name.find('/', prefix.size()) - prefix.size());
        CHECK((other == room || others.contains(other)));
      }
  }
}

TEST_CASE("Includes of the library go one way", "[layout]") {
  check_rooms(library_rooms, library, "bendlab/");
}

/// The first words of the rows of the table "Where a thing is".
std::vector<std::string> rooms_of_readme() {
  static const std::regex row(R"(^\| `(\w+)` \|)");
  std::vector<std::string> names;
  std::ifstream stream(experiments / "README.md");
  for (std::string line; std::getline(stream, line) && !line.starts_with("## Commands");)
    if (std::smatch match; std::regex_search(line, match, row)) names.push_back(match[1]);
  return names;
}

TEST_CASE("Includes of the experiments go one way, in the order of their README", "[layout]") {
  check_rooms({experiment_rooms.begin(), experiment_rooms.end()}, experiments, "experiments/");
  std::vector<std::string> above;
  for (const auto& [room, others] : experiment_rooms) {
    INFO("room " << room);
    for (const std::string& other : others) CHECK(std::ranges::count(above, other) == 1);
    above.push_back(room);
  }
  CHECK(above == rooms_of_readme());
}

/// What the files of a room include of it, by names without extension: a header and its source are one.
using Graph = std::map<std::string, std::set<std::string>>;
Graph includes_within(const fs::path& folder) {
  Graph graph;
  for (const fs::path& file : sources_in(folder)) {
    std::set<std::string>& included = graph[file.stem().string()];
    for (const fs::path name : includes_of(file))
      if (name.parent_path().filename() == folder.filename() && name.stem() != file.stem())
        included.insert(name.stem().string());
  }
  return graph;
}

TEST_CASE("Includes within a room of the experiments go round in no circle", "[layout]") {
  for (const auto& [room, others] : experiment_rooms) {
    if (room == "advise") continue;  // its answer and the reasons for it know each other
    Graph graph = includes_within(experiments / room);
    const auto is_leaf = [&](const auto& file) {
      return std::ranges::none_of(file.second, [&](const std::string& name) { return graph.contains(name); });
    };
    while (std::erase_if(graph, is_leaf) > 0) {
    }
    std::string circle;
    for (const auto& [file, included] : graph) circle += file + " ";
    INFO("room " << room << ", files in circles or above them: " << circle);
    CHECK(graph.empty());
  }
}

TEST_CASE("CGAL stays in the sources of the mesh room and HDF5 in io", "[layout]") {
  for (const char* folder : {"lib/bendlab", "experiments"}) {
    for (const fs::path& file : sources_in(fs::path(bendlab::places::source) / folder)) {
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
