#include "noise/sensors/profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/fields.hpp"
#include "core/resources.hpp"

namespace touchdown::noise {

namespace {

constexpr double largest = 1e4;  ///< limit of biases, standard deviations and resolutions

/// Kind of sensor; it determines which disturbances apply.
enum class SensorKind { joint, imu, attitude };

constexpr std::array joints = {"hip", "knee", "wheel"};
constexpr std::array axes = {"x", "y", "z"};

void describe_low_pass(Fields& fields, double& time_constant) {
  fields.within("low_pass", [&](Fields& filter) {
    if (!filter.present("cut_off", false)) {
      filter.know("cut_off");
      return filter("time_constant", time_constant, 0.0, 100.0);
    }
    double cut_off = 0.0;
    filter("cut_off", cut_off, 1e-3, 1e6);
    filter.check(!filter.present("time_constant", false), "cut_off",
                 "expected either a cut-off frequency (Hz) or a time constant (s)");
    time_constant = 1.0 / (2.0 * std::numbers::pi * cut_off);
  });
}

/// Disturbances of the value.
void describe_values(Fields& fields, SensorChannel& channel, SensorKind kind) {
  if (kind != SensorKind::attitude) {
    fields.within("scale", [&](Fields& scale) {
      scale("value", channel.scale.value, -1.0, 10.0);
      scale("sd", channel.scale.sd, 0.0, 1.0);
    });
  }
  fields.within("bias", [&](Fields& bias) {
    bias("value", channel.bias.value, -largest, largest);
    bias("sd", channel.bias.sd, 0.0, largest);
    bias("walk", channel.walk, 0.0, largest);
  });
  if (kind == SensorKind::imu) {
    fields.within("vibration", [&](Fields& vibration) {
      vibration("amplitude", channel.vibration.amplitude, 0.0, largest);
      vibration("order", channel.vibration.order, 1e-3, 1e3);
    });
  }
  fields.within("coloured", [&](Fields& coloured) {
    coloured("sd", channel.coloured.sd, 0.0, largest);
    coloured("time_constant", channel.coloured.time_constant, 1e-6, 1e6);
  });
  if (kind != SensorKind::attitude) describe_low_pass(fields, channel.low_pass);
  fields("white", channel.white, 0.0, largest);
  if (kind == SensorKind::attitude) return;
  if (fields.reading() || std::isfinite(channel.range)) fields("range", channel.range, 1e-9, 1e9);
  fields("resolution", channel.resolution, 0.0, largest);
}

/// Disturbances of the timing.
void describe_clock(Fields& fields, SensorChannel& channel) {
  fields("rate", channel.rate, 0.0, 1e6);
  fields("delay", channel.delay, 0.0, 10.0);
  fields.within("dropout", [&](Fields& dropout) {
    dropout.choose("kind", {"missing", "frozen", "nan"}, channel.dropout.kind);
    dropout("rate", channel.dropout.rate, 0.0, 1.0);
    dropout("length", channel.dropout.length, 1e-6, 1e3);
  });
}

/// Keys of a sensor apply to all three of its channels. Keys under a channel's name override them
/// for this channel.
void describe_sensor(Fields& fields, std::string_view key, std::array<SensorChannel, 3>& channels,
                     const std::array<const char*, 3>& names, SensorKind kind) {
  fields.within(key, [&](Fields& sensor) {
    const bool is_joint = kind == SensorKind::joint;
    const bool alike = channels[0] == channels[1] && channels[0] == channels[2];
    SensorChannel common = channels[0];
    if (sensor.reading() || alike) describe_values(sensor, common, kind);
    if (sensor.reading() || alike || !is_joint) describe_clock(sensor, common);
    if (sensor.reading()) channels.fill(common);
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (!sensor.present(names[i], !alike)) {
        sensor.know(names[i]);
        continue;
      }
      sensor.within(names[i], [&](Fields& one) {
        describe_values(one, channels[i], kind);
        if (is_joint) describe_clock(one, channels[i]);
      });
    }
  });
}

}  // namespace

void describe(Fields& fields, SensorProfile& profile) {
  describe_sensor(fields, "torque", profile.torque, joints, SensorKind::joint);
  describe_sensor(fields, "position", profile.position, joints, SensorKind::joint);
  describe_sensor(fields, "velocity", profile.velocity, joints, SensorKind::joint);
  describe_sensor(fields, "accelerometer", profile.accelerometer, axes, SensorKind::imu);
  describe_sensor(fields, "gyroscope", profile.gyroscope, axes, SensorKind::imu);
  describe_sensor(fields, "orientation", profile.orientation, axes, SensorKind::attitude);
  fields.within("misalignment", [&](Fields& misalignment) {
    Misalignment& angle = profile.misalignment;
    misalignment("roll", angle.roll, -std::numbers::pi, std::numbers::pi);
    misalignment("pitch", angle.pitch, -std::numbers::pi, std::numbers::pi);
    misalignment("yaw", angle.yaw, -std::numbers::pi, std::numbers::pi);
    misalignment("sd", angle.sd, 0.0, 1.0);
  });
}

bool is_ideal(const SensorChannel& channel) {
  return channel.scale == Constant() && channel.bias == Constant() && channel.walk == 0.0 &&
         channel.vibration.amplitude == 0.0 && channel.coloured.sd == 0.0 &&
         channel.low_pass == 0.0 && channel.white == 0.0 && std::isinf(channel.range) &&
         channel.resolution == 0.0 && channel.rate == 0.0 && channel.delay == 0.0 &&
         channel.dropout.rate == 0.0;
}

bool is_ideal(const AxisChannels& channels) {
  return std::all_of(channels.begin(), channels.end(),
                     [](const SensorChannel& channel) { return is_ideal(channel); });
}

bool is_ideal(const SensorProfile& profile) {
  return is_ideal(profile.torque) && is_ideal(profile.position) && is_ideal(profile.velocity) &&
         is_ideal(profile.accelerometer) && is_ideal(profile.gyroscope) &&
         is_ideal(profile.orientation) && profile.misalignment == Misalignment();
}

SensorProfile find_sensor_profile(const std::filesystem::path& path) {
  return from_yaml<SensorProfile>(YamlDocument::load(find_resource(path)));
}

std::string to_yaml(const SensorProfile& profile) { return YAML::Dump(to_node(profile)) + "\n"; }

}  // namespace touchdown::noise
