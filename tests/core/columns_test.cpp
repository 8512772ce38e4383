#include "core/columns.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace touchdown {
namespace {

struct Place {
  std::string scene;
  double noise = 0.0;
};

struct Row {
  Place place;
  Interval accuracy;
  double delay = 0.0;
  int runs = 0;
  bool is_best = false;
};

Columns<Row> columns() {
  return Columns<Row>()
      .part(&Row::place, Columns<Place>()
                             .text("scenario", &Place::scene)
                             .as("scene")
                             .level("noise", &Place::noise))
      .interval("accuracy", &Row::accuracy)
      .metric("delay_ms", [](const Row& row) { return 1e3 * row.delay; })
      .runs("runs", &Row::runs)
      .flag("is_best", &Row::is_best)
      .is(ColumnRole::note);
}

TEST(Columns, WriteOneLinePerRow) {
  const std::vector<Row> rows = {{{"stairs", 0.5}, {0.9, 0.8, 1.0}, 0.02, 4, true},
                                 {{"a,b", 1.0}, {NAN, NAN, NAN}, 0.0, 0, false}};
  EXPECT_EQ(to_csv(columns().table(rows)),
            "scenario,noise,accuracy,accuracy_low,accuracy_high,delay_ms,runs,is_best\n"
            "stairs,0.5,0.900000,0.800000,1.000000,20.000000,4,1\n"
            "\"a,b\",1,nan,nan,nan,0.000000,0,0\n");
}

TEST(Columns, KeepTheUnitOfBoundsLast) {
  const auto latency = Columns<Row>().interval("latency_ms", &Row::accuracy);
  EXPECT_EQ(latency.header(),
            (std::vector<std::string>{"latency_ms", "latency_low_ms", "latency_high_ms"}));
}

TEST(Columns, StateTheirRolesAndTheirNamesInLongTables) {
  const std::vector<ColumnInfo> infos = columns().infos();
  ASSERT_EQ(infos.size(), 6U);
  EXPECT_EQ(infos[0].as, "scene");
  EXPECT_EQ(infos[1].as, "noise");
  EXPECT_EQ(infos[1].role, ColumnRole::key);
  EXPECT_EQ(infos[2].role, ColumnRole::metric);
  EXPECT_TRUE(infos[2].has_bounds);
  EXPECT_FALSE(infos[3].has_bounds);
  EXPECT_EQ(infos[4].role, ColumnRole::runs);
  EXPECT_EQ(infos[5].role, ColumnRole::note);
}

}  // namespace
}  // namespace touchdown
