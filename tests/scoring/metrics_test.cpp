#include "scoring/metrics.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace touchdown::scoring {
namespace {

TEST(Metrics, AnUnknownNameSuggestsTheNearestOne) {
  EXPECT_THROW(metric_index("sucess"), InputError);
}

}  // namespace
}  // namespace touchdown::scoring
