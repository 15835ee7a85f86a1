// Which machine this is, and its clocks: for what runs and benchmarks record about themselves.
#pragma once

#include <string>

namespace bendlab {

std::string processor_name();  ///< "unknown" where the system does not say
std::string host_name();
/// For which processor the BLAS chose its kernels, "SkylakeX"; "unknown" if it does not say.
std::string blas_kernels();
/// "Eigen 3.4.0, CGAL 5.5.1, …": of the libraries that decide results.
std::string library_versions();
std::string utc_now();  ///< "2026-01-31T12:00:00Z"

double thread_cpu_s();  ///< processor time of the calling thread, s

}  // namespace bendlab
