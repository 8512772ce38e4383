#pragma once

#include <string>

namespace touchdown::training {

/// The BLAS library that the dynamic linker gave to libtorch, links resolved; empty if unknown.
std::string blas_in_use();

/// A warning with advice about a BLAS library; empty for a good one. libtorch uses it for matrix
/// products, which dominate training time: Debian's reference BLAS is about twenty times slower
/// than OpenBLAS.
std::string blas_warning(const std::string& library);

}  // namespace touchdown::training
