// CHOLMOD computes with BLAS, which may start threads.
#pragma once

namespace bendlab {

/// If CHOLMOD uses OpenBLAS, OpenBLAS no longer starts threads of its own in every product. Several runs at
/// the same time use the cores better than several threads of a product. (OpenBLAS built without threads is
/// no alternative, because it may not be called from several threads.)
void one_blas_thread();

}  // namespace bendlab
