#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/fields.hpp"
#include "core/resources.hpp"
#include "noise/sensor_profile.hpp"
#include "tests/documented_defaults.hpp"

namespace touchdown::noise {
namespace {

using ::testing::IsEmpty;

SensorProfile read(const std::string& text) {
  return from_yaml<SensorProfile>(YamlDocument::parse(text, "s.yaml"));
}

TEST(SensorProfile, AppliesKeysOfASensorToAllItsChannelsUnlessAChannelOverridesThem) {
  const SensorProfile profile = read(
      "torque: {white: 0.1, resolution: 0.01, wheel: {white: 0.02}}\n"
      "accelerometer: {rate: 400, bias: {sd: 0.2}, z: {bias: {value: 0.5}}}\n");
  EXPECT_EQ(profile.torque[0].white, 0.1);
  EXPECT_EQ(profile.torque[1].white, 0.1);
  EXPECT_EQ(profile.torque[2].white, 0.02);
  EXPECT_EQ(profile.torque[2].resolution, 0.01);
  EXPECT_EQ(profile.accelerometer[0].bias, (Constant{0.0, 0.2}));
  EXPECT_EQ(profile.accelerometer[2].bias, (Constant{0.5, 0.2}));
  EXPECT_EQ(profile.accelerometer[2].rate, 400.0);
  EXPECT_EQ(profile.position, SensorProfile().position);
  const SensorProfile filtered = read("velocity: {low_pass: {cut_off: 100.0}}\n");
  EXPECT_NEAR(filtered.velocity[1].low_pass, 1.0 / 628.3185307179587, 1e-12);
}

TEST(SensorProfile, ThatIsWrittenReadsBackToTheSame) {
  const SensorProfile profile = read(
      "torque: {scale: {sd: 0.03}, knee: {dropout: {kind: nan, rate: 0.01, length: 0.02}}}\n"
      "velocity: {low_pass: {cut_off: 123.4}, delay: 0.002, range: 28.8}\n"
      "position: {white: 0.1, degrees_of_freedom: 5, wheel: {degrees_of_freedom: 2.5}}\n"
      "accelerometer: {range: 157, vibration: {amplitude: 0.1, order: 2}, rate: 333,\n"
      "                dropout: {kind: missing, rate: 1e-3}, x: {white: 0.1}}\n"
      "orientation: {coloured: {sd: 0.01, time_constant: 3}}\n"
      "gyroscope: {mount: {frequency: 45, damping: 0.2}}\nleg_skew: 0.004\n"
      "misalignment: {pitch: 0.02, sd: 0.01}\n");
  EXPECT_EQ(read(to_yaml(profile)), profile);
  EXPECT_FALSE(is_ideal(profile));
}

TEST(SensorProfile, IsNotIdealOnceAnyOfItsDisturbancesChangesAnything) {
  for (const char* text :
       {"torque: {scale: {value: 0.1}}", "torque: {bias: {sd: 0.1}}",
        "position: {bias: {walk: 0.1}}", "gyroscope: {vibration: {amplitude: 0.1}}",
        "velocity: {coloured: {sd: 0.1}}", "velocity: {hip: {low_pass: {time_constant: 0.1}}}",
        "velocity: {white: 0.1}", "accelerometer: {z: {range: 100}}", "position: {resolution: 0.1}",
        "gyroscope: {rate: 100}", "orientation: {delay: 0.1}", "leg_skew: 0.002",
        "accelerometer: {mount: {frequency: 30}}", "torque: {wheel: {dropout: {rate: 0.1}}}",
        "misalignment: {yaw: 0.1}"}) {
    EXPECT_FALSE(is_ideal(read(text))) << text;
  }
  EXPECT_EQ(read("{}"), SensorProfile());
  EXPECT_TRUE(is_ideal(SensorProfile()));
  EXPECT_TRUE(is_ideal(read("gyroscope: {vibration: {order: 3}, dropout: {kind: nan}}")));
  EXPECT_TRUE(is_ideal(read("torque: {degrees_of_freedom: 3}")));  // without white noise
}

TEST(SensorProfile, OfEveryShippedFileIsReadAndOnlyTheIdealOneIsIdeal) {
  const auto files = resources_in("noise/profiles", ".yaml");
  EXPECT_GE(files.size(), 3U);
  for (const auto& file : files) {
    EXPECT_EQ(is_ideal(find_sensor_profile(file)), file == "noise/profiles/ideal.yaml") << file;
  }
}

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
  SensorProfile expected = find_sensor_profile("noise/profiles/harsh.yaml");
  const SensorProfile varied = with_value(expected, "torque.white", 0.7);
  for (SensorChannel& channel : expected.torque) channel.white = 0.7;
  EXPECT_EQ(varied, expected);
}

TEST(AVariedProfile, DiffersInTheNamedChannelAlone) {
  SensorProfile expected;
  expected.accelerometer[2].bias.sd = 0.4;
  EXPECT_EQ(with_value({}, "accelerometer.z.bias", 0.4), expected);
  EXPECT_EQ(with_value({}, "gyroscope.vibration", 0.1).gyroscope[1].vibration.amplitude, 0.1);
  EXPECT_EQ(with_value({}, "leg_skew", 0.01).leg_skew, 0.01);
}

TEST(SensorKeys, HaveTheDefaultsOfAFileThatGivesNone) {
  const auto compared =
      tests::compared_defaults(documented_keys(SensorProfile()), to_yaml(SensorProfile()));
  EXPECT_THAT(compared.different, IsEmpty());
  EXPECT_GT(compared.equal, 80U);
}

}  // namespace
}  // namespace touchdown::noise
