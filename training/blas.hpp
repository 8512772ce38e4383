#pragma once

#include <string>

namespace touchdown::training {

/// Which BLAS the dynamic linker gave to libtorch.
struct BlasReport {
  std::string library;  ///< the file, links resolved; empty if it cannot be told
  std::string warning;  ///< what to do about it; empty if it is a good one
};

/// What libtorch calls for matrix products decides how long training takes: Debian's reference BLAS
/// is about twenty times slower than OpenBLAS.
BlasReport blas_in_use();

/// The same for a given library.
BlasReport judge_blas(const std::string& library);

}  // namespace touchdown::training
