#include "noise/sensors/factor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"

namespace touchdown::noise {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(AVariedProfile, HasTheDropoutOfEverySensorAtTheValue) {
  const SensorProfile varied = with_value({}, "dropout", 0.05);
  for (const auto* sensor : {&varied.torque, &varied.position, &varied.velocity,
                             &varied.accelerometer, &varied.gyroscope, &varied.orientation}) {
    for (const SensorChannel& channel : *sensor) {
      EXPECT_EQ(channel.dropout.rate, 0.05);
      EXPECT_EQ(channel.dropout.kind, DropoutKind::frozen);
    }
  }
  EXPECT_EQ(with_value(varied, "dropout", 0.0), SensorProfile());
}

TEST(AVariedProfile, DiffersInTheNamedSensorAlone) {
  SensorProfile expected = find_sensor_profile("sensors/harsh.yaml");
  const SensorProfile varied = with_value(expected, "torque.white", 0.7);
  for (SensorChannel& channel : expected.torque) channel.white = 0.7;
  EXPECT_EQ(varied, expected);
}

TEST(AVariedProfile, DiffersInTheNamedChannelAlone) {
  SensorProfile expected;
  expected.accelerometer[2].bias.sd = 0.4;
  EXPECT_EQ(with_value({}, "accelerometer.z.bias", 0.4), expected);
}

TEST(AVariedProfile, ShakesOnlyWhatCanVibrate) {
  EXPECT_THAT([] { with_value({}, "torque.vibration", 0.1); },
              ThrowsMessage<InputError>(HasSubstr("'vibration' is not one of scale, bias")));
  EXPECT_EQ(with_value({}, "gyroscope.vibration", 0.1).gyroscope[1].vibration.amplitude, 0.1);
}

TEST(AVariedProfile, RefusesWhatThereIsNot) {
  const auto refused = [](const char* key, double value, const char* why) {
    EXPECT_THAT([&] { with_value({}, key, value); }, ThrowsMessage<InputError>(HasSubstr(why)))
        << key;
  };
  refused("dropot", 0.1, "did you mean 'dropout'?");
  refused("white", 0.1,
          "'white' is not one of scale, low_pass, degrees_of_freedom, rate, delay, dropout");
  refused("acelerometer.delay", 0.1, "did you mean 'accelerometer'?");
  refused("torque.kne.white", 0.1, "did you mean 'knee'?");
  refused("accelerometer.z.delay", 0.1, "'delay' is not one of scale, bias");
  refused("a.b.c.d", 0.1, "expected a disturbance");
  refused("", 0.1, "expected a disturbance");
  refused("dropout", 2.0, "dropout.rate: expected a number from 0 to 1");
  refused("delay", -0.001, "delay: expected a number from 0 to 10");
}

}  // namespace
}  // namespace touchdown::noise
