#include "experiments/results/json_table.hpp"

#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

TEST(JsonTable, HasNumbersAsNumbersAndNothingForNan) {
  const auto json =
      json_of(Table{{"name", "value", "other"}, {{"a", "0.25", "nan"}, {"1e", "3", ""}}});
  EXPECT_EQ(json.dump(),
            R"([{"name":"a","value":0.25,"other":null},{"name":"1e","value":3.0,"other":""}])");
}

}  // namespace
}  // namespace touchdown::experiments
