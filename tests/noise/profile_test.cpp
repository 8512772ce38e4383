#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "core/resources.hpp"
#include "noise/sensor_profile.hpp"
#include "tests/complaint.hpp"
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

TEST(SensorProfile, IsRefusedWithPlaceKeyAndExpectation) {
  expect_refused(
      {{"torque:\n  delay: -0.001\n",
        {"^s.yaml:2:10: torque.delay: expected a number from 0 to 10"}},
       {"torque:\n  knee:\n    dropout: {rate: 2}\n",
        {"^s.yaml:3:21: torque.knee.dropout.rate: expected a number from 0 to 1"}},
       {"gyroscope: {white: .nan}",
        {"^s.yaml:1:20: gyroscope.white: expected a number from 0 to 10000"}},
       {"torque: {degrees_of_freedom: 2}",
        {"torque.degrees_of_freedom: expected a number from 2.1 to"}},
       {"orientation: {x: {degrees_of_freedom: .inf}}",
        {"orientation.x.degrees_of_freedom: expected a number from 2.1 to"}},
       {"accelerometer: {range: 0}", {"accelerometer.range: expected a number from 1e-09 to"}},
       {"accelerometer: {bias: 0.3}", {"accelerometer.bias: expected a mapping of keys to values"}},
       {"accelerometer: {white: high}", {"accelerometer.white: expected a number"}},
       {"accelerometre: {white: 1}",
        {"s.yaml:1:1: accelerometre: unknown key", "did you mean 'accelerometer'?"}},
       {"torque:\n  ancle: {white: 1}\n", {"s.yaml:2:3: torque.ancle: unknown key"}},
       {"torque: {dropout: {kind: frosen}}",
        {"expected one of missing, frozen, nan", "did you mean 'frozen'?"}},
       {"position: {resolutoin: 0.1}", {"did you mean 'resolution'?"}},
       // What would mean nothing there; the axes of an IMU have one clock.
       {"torque: {vibration: {amplitude: 1}}", {"unknown key"}},
       {"orientation: {range: 1}", {"unknown key"}},
       {"gyroscope: {x: {delay: 0.1}}", {"unknown key"}},
       {"torque: {low_pass: {cut_off: 10, time_constant: 1}}",
        {"torque.low_pass.cut_off: expected either"}}},
      read);
  expect_refused(
      {{"noise/profiles/upkei.yaml",
        {"noise/profiles/upkei.yaml: no such file", "did you mean 'noise/profiles/upkie.yaml'?"}}},
      [](const std::string& file) { return find_sensor_profile(file); });
  const auto vary = [](const std::string& assignment) {
    const std::size_t at = assignment.find('=');
    return with_value({}, assignment.substr(0, at), std::stod(assignment.substr(at + 1)));
  };
  expect_refused(
      {{"dropot=0.1", {"did you mean 'dropout'?"}},
       {"white=0.1",
        {"'white' is not one of scale, low_pass, degrees_of_freedom, rate, delay, dropout"}},
       {"acelerometer.delay=0.1", {"did you mean 'accelerometer'?"}},
       {"torque.kne.white=0.1", {"did you mean 'knee'?"}},
       {"accelerometer.z.delay=0.1", {"'delay' is not one of scale, bias"}},
       {"torque.vibration=0.1", {"'vibration' is not one of scale, bias"}},
       {"a.b.c.d=0.1", {"expected a disturbance"}},
       {"=0.1", {"expected a disturbance"}},
       {"dropout=2", {"dropout.rate: expected a number from 0 to 1"}},
       {"delay=-0.001", {"delay: expected a number from 0 to 10"}}},
      vary);
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
