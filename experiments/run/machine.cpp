#include "experiments/run/machine.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <gnu/libc-version.h>
#include <unistd.h>

#include <Eigen/Core>
#include <array>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bendlab/io/run_file.hpp"
#include "bendlab/mesh/mesh_surface.hpp"

namespace bendlab {

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string host_name() {
  char name[256] = {};
  return gethostname(name, sizeof(name) - 1) == 0 ? name : "unknown";
}

// The name is looked up at run time, because the system may load another BLAS than at compile time.
std::string blas_kernels() {
  using CoreName = const char* (*)();
  const auto core = reinterpret_cast<CoreName>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  return core ? core() : "unknown";
}

std::string library_versions() {
  std::array<int, 3> cholmod{};
  using CholmodVersion = int (*)(int*);
  if (const auto version = reinterpret_cast<CholmodVersion>(dlsym(RTLD_DEFAULT, "cholmod_version")))
    version(cholmod.data());
  return fmt::format(
      "Eigen {}.{}.{}, CGAL {}, HDF5 {}, JSON for Modern C++ {}.{}.{}, CHOLMOD {}.{}.{}, glibc {}",
      EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, cgal_version(), hdf5_version(),
      NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH, cholmod[0],
      cholmod[1], cholmod[2], gnu_get_libc_version());
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32] = {};
  std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace bendlab
