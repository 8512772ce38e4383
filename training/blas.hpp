#pragma once

#include <string>

namespace touchdown::training {

/// The file of the BLAS that the dynamic linker gave to libtorch, links resolved; empty if it
/// cannot be told.
std::string blas_in_use();

/// What to do about a library; empty if it is a good one. What libtorch calls for matrix products
/// decides how long training takes: Debian's reference BLAS is about twenty times slower than
/// OpenBLAS.
std::string blas_warning(const std::string& library);

}  // namespace touchdown::training
