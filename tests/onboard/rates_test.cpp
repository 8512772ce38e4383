// The load filter has constants in seconds: its model serves all usual rates, through C++ and C
// alike, and one robot.
#include <array>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/models/make_estimator.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "estimator/touchdown.h"
#include "logs/model_file.hpp"
#include "tests/complaint.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown {
namespace {

using ::testing::HasSubstr;

class LoadFilterModel : public ::testing::Test {
 protected:
  LoadFilterModel() { logs::save_model(load_filter_model({}, 1000.0, "upkie"), file_); }

  /// The complaint of C about a rate, or a robot; empty if the estimator was created.
  std::string complaint_of_c(double rate, const char* robot = nullptr) const {
    std::array<char, 300> error{};
    const touchdown_use use{nullptr, rate, robot};
    touchdown_estimator* estimator =
        touchdown_create(file_.c_str(), &use, error.data(), error.size());
    touchdown_destroy(estimator);
    return error.data();
  }

  const ScratchFolder folder_;
  const std::filesystem::path file_ = folder_ / "m.npz";
};

TEST_F(LoadFilterModel, ServesItsRatesThroughCAndCpp) {
  for (const double rate : {100.0, 200.0, 250.0, 999.0, 1000.0, 1009.0, 2000.0, 20'000.0}) {
    EXPECT_NO_THROW((void)load_estimator(file_, {.sample_rate = rate})) << rate;
    EXPECT_EQ(complaint_of_c(rate), "") << rate;
  }
  for (const double rate : {50.0, 98.0, 21'000.0}) {
    EXPECT_THROW((void)load_estimator(file_, {.sample_rate = rate}), InputError) << rate;
    EXPECT_THAT(complaint_of_c(rate), HasSubstr("serves 100 to 20000 Hz"));
  }
}

TEST_F(LoadFilterModel, ServesItsRobotAloneThroughCAndCpp) {
  EXPECT_EQ(complaint_of_c(0.0, "upkie"), "");
  EXPECT_NO_THROW((void)load_estimator(file_, {.robot = "upkie"}));
  for (const char* robot : {"mine", "upkie_heavy", "Upkie", "upkie "}) {
    const std::string expected = std::string("not to '") + robot + "'";
    EXPECT_THAT(complaint_of_c(0.0, robot), HasSubstr(expected));
    EXPECT_THAT(complaint_of([&] { load_estimator(file_, {.robot = robot}); }),
                HasSubstr(expected));
  }
}

}  // namespace
}  // namespace touchdown
