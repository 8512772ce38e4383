#include "estimator/free_fall.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace touchdown {
namespace {

/// Steps of one millisecond under a constant vertical acceleration.
class Fall {
 public:
  const Belief& update(double acceleration, int steps) {
    for (int i = 0; i < steps; ++i) {
      signals_.time += 0.001;
      // Real accelerometers never repeat themselves to the bit.
      signals_.vertical_acceleration = acceleration + 1e-9 * static_cast<double>(i % 2);
      belief_ = estimator_.update(signals_);
    }
    return belief_;
  }
  FreeFall& estimator() { return estimator_; }

 private:
  FreeFall estimator_;
  Signals signals_;
  Belief belief_;
};

TEST(FreeFall, StandingIsContactAndFallingIsNot) {
  Fall fall;
  EXPECT_GT(fall.update(0.0, 1000).wheel[0].p_contact, 0.99);
  EXPECT_TRUE(fall.update(0.0, 1).wheel[1].contact);
  EXPECT_LT(fall.update(-9.81, 100).p_any_wheel, 0.01);
  EXPECT_FALSE(fall.update(-9.81, 1).wheel[0].contact);
  EXPECT_TRUE(fall.update(0.0, 100).wheel[0].contact);
}

TEST(FreeFall, DecidesWhenTheLowPassHasComeHalfWay) {
  // −g (1 − e^(−t/τ)) = −4.9 at t = τ ln(g / (g − 4.9)) = 6.92 ms.
  Fall fall;
  fall.update(0.0, 1000);
  EXPECT_TRUE(fall.update(-9.81, 6).wheel[0].contact);
  EXPECT_FALSE(fall.update(-9.81, 1).wheel[0].contact);
}

TEST(FreeFall, TakesHangingForContact) {
  Fall fall;
  EXPECT_TRUE(fall.update(0.0, 500).wheel[0].contact) << "a rope carries as well as the ground";
}

TEST(FreeFall, FadesToThePriorWithoutAnAcceleration) {
  Fall fall;
  fall.update(-9.81, 200);
  const Belief& belief = fall.update(std::nan(""), 2000);
  EXPECT_NEAR(belief.wheel[0].p_contact, 0.5, 1e-6);
  EXPECT_EQ(belief.status, SignalStatus::invalid);
  EXPECT_TRUE(fall.update(0.0, 100).wheel[0].contact);
}

TEST(FreeFall, KnowsNoLoads) {
  Fall fall;
  EXPECT_TRUE(std::isnan(fall.update(0.0, 100).wheel[0].load.force));
}

TEST(FreeFall, RefusesInvalidValues) {
  EXPECT_THROW(FreeFall({.width = 0.0}), InputError);
  EXPECT_THROW(FreeFall({.low_pass = -1.0}), InputError);
  EXPECT_THROW(FreeFall({.sample_rate = 0.0}), InputError);
}

}  // namespace
}  // namespace touchdown
