// CHOLMOD computes with BLAS, which may start threads.
#pragma once

namespace bendlab {

/// From now on OpenBLAS, if CHOLMOD uses it, starts no threads of its own for every product. Runs side by
/// side use the cores better. (The build of OpenBLAS without threads may not be called from several threads.)
void one_blas_thread();

}  // namespace bendlab
