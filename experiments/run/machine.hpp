// Names and clocks of the machine, for the records of runs and benchmarks.
#pragma once

#include <string>

namespace bendlab {

std::string processor_name();  ///< "unknown" where the system does not say
std::string host_name();
/// The processor for which the BLAS chose its kernels, "SkylakeX"; "unknown" if the BLAS does not say.
std::string blas_kernels();
/// "Eigen 3.4.0, CGAL 5.5.1, …": the libraries that affect results.
std::string library_versions();
std::string utc_now();  ///< "2026-01-31T12:00:00Z"

double thread_cpu_s();  ///< processor time of the calling thread, s

}  // namespace bendlab
