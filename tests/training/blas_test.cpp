#include "training/blas.hpp"

#include <gmock/gmock.h>

namespace touchdown::training {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(Blas, WarnsOfTheReferenceLibraryAndNamesThePackage) {
  EXPECT_THAT(blas_warning("/usr/lib/x86_64-linux-gnu/blas/libblas.so.3.11.0"),
              HasSubstr("install the package libopenblas0-openmp"));
}

TEST(Blas, WarnsOfCompetingThreads) {
  EXPECT_THAT(blas_warning("/usr/lib/x86_64-linux-gnu/openblas-pthread/libblas.so.3"),
              HasSubstr("openblas-pthread"));
}

TEST(Blas, AcceptsTheRecommendedLibrary) {
  EXPECT_THAT(blas_warning("/usr/lib/x86_64-linux-gnu/openblas-openmp/libblas.so.3"), IsEmpty());
}

TEST(Blas, FindsTheLoadedLibrary) { EXPECT_THAT(blas_in_use(), HasSubstr("blas")); }

}  // namespace
}  // namespace touchdown::training
