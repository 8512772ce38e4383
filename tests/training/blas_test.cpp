#include "training/blas.hpp"

#include <gmock/gmock.h>

namespace touchdown::training {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(Blas, WarnsOfTheReferenceLibraryAndSaysWhatToInstall) {
  EXPECT_THAT(judge_blas("/usr/lib/x86_64-linux-gnu/blas/libblas.so.3.11.0").warning,
              HasSubstr("install the package libopenblas0-openmp"));
}

TEST(Blas, WarnsOfThreadsThatFightEachOther) {
  EXPECT_THAT(judge_blas("/usr/lib/x86_64-linux-gnu/openblas-pthread/libblas.so.3").warning,
              HasSubstr("openblas-pthread"));
}

TEST(Blas, IsContentWithTheOneThatIsAskedFor) {
  EXPECT_THAT(judge_blas("/usr/lib/x86_64-linux-gnu/openblas-openmp/libblas.so.3").warning,
              IsEmpty());
}

TEST(Blas, FindsTheOneThatIsLoaded) { EXPECT_THAT(blas_in_use().library, HasSubstr("blas")); }

}  // namespace
}  // namespace touchdown::training
