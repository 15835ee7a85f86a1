// CHOLMOD computes with BLAS, which may start threads.
#pragma once

namespace bendlab {

/// Stops OpenBLAS, if CHOLMOD uses it, from starting its own threads in every product. Runs side by side use
/// the cores better. (OpenBLAS built without threads is no alternative: it may not be called from several
/// threads.)
void one_blas_thread();

}  // namespace bendlab
