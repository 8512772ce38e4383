#include "training/blas.hpp"

#include <dlfcn.h>
#include <filesystem>

#include <fmt/format.h>

namespace touchdown::training {

std::string blas_warning(const std::string& library) {
  const auto has = [&](const char* text) { return library.find(text) != std::string::npos; };
  constexpr const char* advice =
      "install the package libopenblas0-openmp, or choose it with "
      "'update-alternatives --config libblas.so.3-x86_64-linux-gnu'";
  if (has("/blas/libblas")) {
    return fmt::format(
        "libtorch uses the reference BLAS ({}): training will take about twenty times as long; {}",
        library, advice);
  }
  if (has("openblas-pthread") || has("openblas-serial")) {
    return fmt::format("libtorch uses {}, which does not share its threads with libtorch; {}",
                       library, advice);
  }
  return "";
}

std::string blas_in_use() {
  void* const symbol = ::dlsym(RTLD_DEFAULT, "sgemm_");
  Dl_info info = {};
  if (symbol == nullptr || ::dladdr(symbol, &info) == 0) return {};
  std::error_code ignored;
  const auto path = std::filesystem::canonical(info.dli_fname, ignored);
  return ignored ? info.dli_fname : path.string();
}

}  // namespace touchdown::training
