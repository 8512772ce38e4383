#include "noise/sensor_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "core/resources.hpp"

namespace touchdown::noise {

namespace {

constexpr double largest = 1e4;  ///< limit of biases, standard deviations and resolutions

constexpr std::array joints = {"hip", "knee", "wheel"};
constexpr std::array axes = {"x", "y", "z"};

/// Kind of sensor; it determines which disturbances apply.
enum class SensorKind { joint, imu, attitude };

/// A sensor with its key, unit and meaning, as in the reference of keys.
struct Sensor {
  const char* name;
  std::array<SensorChannel, 3> SensorProfile::*channels;
  SensorKind kind;
  const char* unit;
  const char* meaning;

  const std::array<const char*, 3>& channel_names() const {
    return kind == SensorKind::joint ? joints : axes;
  }
};
constexpr std::array sensors = {
    Sensor{"torque", &SensorProfile::torque, SensorKind::joint, "N·m",
           "Joint torques, reported by the servos."},
    Sensor{"position", &SensorProfile::position, SensorKind::joint, "rad", "Joint positions."},
    Sensor{"velocity", &SensorProfile::velocity, SensorKind::joint, "rad/s", "Joint velocities."},
    Sensor{"accelerometer", &SensorProfile::accelerometer, SensorKind::imu, "m/s²",
           "Acceleration of the IMU, gravity included."},
    Sensor{"gyroscope", &SensorProfile::gyroscope, SensorKind::imu, "rad/s",
           "Angular velocity of the IMU."},
    Sensor{"orientation", &SensorProfile::orientation, SensorKind::attitude, "rad",
           "Error of the IMU's attitude, about its axes."}};

enum class Affects { all, imu, all_but_attitude };

/// A disturbance that a study can vary, with the number that sets its size.
struct VariedDisturbance {
  const char* name;
  double& (*of)(SensorChannel& channel);
  Affects affects;
  bool has_no_unit;  ///< may be set for all sensors at once
  bool is_shared_by_axes = false;

  bool is_of(const Sensor& sensor) const {
    if (affects == Affects::imu) return sensor.kind == SensorKind::imu;
    return affects == Affects::all || sensor.kind != SensorKind::attitude;
  }
};
constexpr std::array disturbances = {
    VariedDisturbance{"scale", [](SensorChannel& c) -> double& { return c.scale.sd; },
                      Affects::all_but_attitude, true},
    VariedDisturbance{"bias", [](SensorChannel& c) -> double& { return c.bias.sd; }, Affects::all,
                      false},
    VariedDisturbance{"walk", [](SensorChannel& c) -> double& { return c.walk; }, Affects::all,
                      false},
    VariedDisturbance{"vibration",
                      [](SensorChannel& c) -> double& { return c.vibration.amplitude; },
                      Affects::imu, false},
    VariedDisturbance{"mount", [](SensorChannel& c) -> double& { return c.mount.frequency; },
                      Affects::imu, false},
    VariedDisturbance{"coloured", [](SensorChannel& c) -> double& { return c.coloured.sd; },
                      Affects::all, false},
    VariedDisturbance{"low_pass", [](SensorChannel& c) -> double& { return c.low_pass; },
                      Affects::all_but_attitude, true},
    VariedDisturbance{"white", [](SensorChannel& c) -> double& { return c.white; }, Affects::all,
                      false},
    VariedDisturbance{"degrees_of_freedom",
                      [](SensorChannel& c) -> double& { return c.degrees_of_freedom; },
                      Affects::all, true},
    VariedDisturbance{"range", [](SensorChannel& c) -> double& { return c.range; },
                      Affects::all_but_attitude, false},
    VariedDisturbance{"resolution", [](SensorChannel& c) -> double& { return c.resolution; },
                      Affects::all_but_attitude, false},
    VariedDisturbance{"rate", [](SensorChannel& c) -> double& { return c.rate; }, Affects::all,
                      true, true},
    VariedDisturbance{"delay", [](SensorChannel& c) -> double& { return c.delay; }, Affects::all,
                      true, true},
    VariedDisturbance{"dropout", [](SensorChannel& c) -> double& { return c.dropout.rate; },
                      Affects::all, true, true}};

const char* name_of(const char* name) { return name; }
template <typename Named>
const char* name_of(const Named& named) {
  return named.name;
}

/// Finds the entry named `word` among those that `is_known` accepts. Errors: `InputError`.
template <typename Table, typename Known>
const auto& find(const std::string& word, const Table& table, const Known& is_known) {
  std::vector<std::string> names;
  for (const auto& one : table) {
    if (!is_known(one)) continue;
    if (word == name_of(one)) return one;
    names.emplace_back(name_of(one));
  }
  throw InputError(fmt::format("'{}' is not one of {}{}", word, fmt::join(names, ", "),
                               did_you_mean(word, names)));
}

/// The numbers of the profile that a key names.
std::vector<double*> numbers_of(SensorProfile& profile, std::string_view key) {
  std::vector<std::string> words;
  std::istringstream parts{std::string(key)};
  for (std::string word; std::getline(parts, word, '.');) words.push_back(word);
  if (words.empty() || words.size() > 3) {
    throw InputError("expected a disturbance, of all sensors, one sensor or one channel");
  }
  if (key == "leg_skew") return {&profile.leg_skew};
  std::vector<double*> numbers;
  if (words.size() == 1) {
    const VariedDisturbance& disturbance =
        find(words[0], disturbances, [](const auto& one) { return one.has_no_unit; });
    for (const Sensor& sensor : sensors) {
      if (!disturbance.is_of(sensor)) continue;
      for (SensorChannel& channel : profile.*sensor.channels) {
        numbers.push_back(&disturbance.of(channel));
      }
    }
    return numbers;
  }
  const auto any = [](const auto&) { return true; };
  const Sensor& sensor = find(words[0], sensors, any);
  const bool whole = words.size() == 2;
  const VariedDisturbance& disturbance =
      find(words.back(), disturbances, [&](const VariedDisturbance& one) {
        return one.is_of(sensor) &&
               (whole || sensor.kind == SensorKind::joint || !one.is_shared_by_axes);
      });
  auto& channels = profile.*sensor.channels;
  if (!whole) {
    const auto& names = sensor.channel_names();
    const auto number = static_cast<std::size_t>(&find(words[1], names, any) - names.data());
    return {&disturbance.of(channels[number])};
  }
  for (SensorChannel& channel : channels) numbers.push_back(&disturbance.of(channel));
  return numbers;
}

void describe_low_pass(Fields& fields, double& time_constant) {
  const auto describe_time_constant = [&](Fields& filter) {
    filter("time_constant", time_constant, 0.0, 100.0).doc("s", "Time constant; 0: none.");
  };
  const auto describe_cut_off = [&](Fields& filter) {
    double cut_off = 0.0;
    filter("cut_off", cut_off, 1e-3, 1e6)
        .fallback("none")
        .doc("Hz", "Cut-off frequency instead of the time constant.");
    filter.check(!filter.present("time_constant", false), "cut_off",
                 "expected either a cut-off frequency (Hz) or a time constant (s)");
    if (!filter.documenting()) time_constant = 1.0 / (2.0 * std::numbers::pi * cut_off);
  };
  fields
      .within("low_pass",
              [&](Fields& filter) {
                const bool has_cut_off = filter.given("cut_off", false);
                if (!has_cut_off || filter.documenting()) describe_time_constant(filter);
                if (has_cut_off) describe_cut_off(filter);
              })
      .doc("First-order low-pass of the instrument.");
}

void describe_values(Fields& fields, SensorChannel& channel, const Sensor& sensor) {
  const SensorKind kind = sensor.kind;
  const std::string unit = sensor.unit;
  if (kind != SensorKind::attitude) {
    fields
        .within("scale",
                [&](Fields& scale) {
                  scale("value", channel.scale.value, -1.0, 10.0).doc("Fixed relative error.");
                  scale("sd", channel.scale.sd, 0.0, 1.0)
                      .doc("Standard deviation of a draw per run that is added.");
                })
        .doc("Relative error of the values.");
  }
  fields
      .within("bias",
              [&](Fields& bias) {
                bias("value", channel.bias.value, -largest, largest).doc(unit, "Fixed offset.");
                bias("sd", channel.bias.sd, 0.0, largest)
                    .doc(unit, "Standard deviation of a draw per run that is added.");
                bias("walk", channel.walk, 0.0, largest)
                    .doc(unit + "/√s", "Standard deviation of its random walk after one second.");
              })
      .doc("Offset of the values.");
  if (kind == SensorKind::imu) {
    fields
        .within("vibration",
                [&](Fields& vibration) {
                  vibration("amplitude", channel.vibration.amplitude, 0.0, largest)
                      .doc(unit + " per rad/s", "Amplitude per wheel speed.");
                  vibration("order", channel.vibration.order, 1e-3, 1e3)
                      .doc("Frequency per turning frequency of the wheel.");
                })
        .doc("A sine for each wheel, with its turning frequency.");
    fields
        .within("mount",
                [&](Fields& mount) {
                  mount("frequency", channel.mount.frequency, 0.0, 1e4)
                      .doc("Hz", "Natural frequency; 0: rigid.");
                  mount("damping", channel.mount.damping, 1e-3, 10.0)
                      .doc("Share of the critical damping.");
                })
        .doc("A mount that is a spring and a damper, so that the IMU rings after impacts.");
  }
  fields
      .within("coloured",
              [&](Fields& coloured) {
                coloured("sd", channel.coloured.sd, 0.0, largest)
                    .doc(unit, "Standard deviation of the noise.");
                coloured("time_constant", channel.coloured.time_constant, 1e-6, 1e6)
                    .doc("s", "Time constant of its autocorrelation.");
              })
      .doc("First-order Gauss-Markov noise.");
  if (kind != SensorKind::attitude) describe_low_pass(fields, channel.low_pass);
  fields("white", channel.white, 0.0, largest).doc(unit, "Standard deviation of the white noise.");
  fields
      .if_set(std::isfinite(channel.degrees_of_freedom), "degrees_of_freedom",
              channel.degrees_of_freedom, 2.1, 1e6)
      .fallback("none: a normal distribution")
      .doc(
          "Heavy tails: the white noise has Student's t distribution with these degrees of "
          "freedom, scaled to the same standard deviation.");
  if (kind == SensorKind::attitude) return;
  fields.if_set(std::isfinite(channel.range), "range", channel.range, 1e-9, 1e9)
      .doc(unit, "Values are clipped to ± this.");
  fields("resolution", channel.resolution, 0.0, largest).doc(unit, "Step of the values; 0: none.");
}

void describe_clock(Fields& fields, SensorChannel& channel) {
  fields("rate", channel.rate, 0.0, 1e6)
      .doc("Hz", "Sample rate; samples are held; 0: one per step.");
  fields("delay", channel.delay, 0.0, 10.0).doc("s", "Delay, rounded to whole steps.");
  fields
      .within("dropout",
              [&](Fields& dropout) {
                dropout.choose("kind", {"missing", "frozen", "nan"}, channel.dropout.kind)
                    .doc("Output during a dropout: no record, the last value, or not a number.");
                dropout("rate", channel.dropout.rate, 0.0, 1.0)
                    .doc("Probability per step that a dropout begins.");
                dropout("length", channel.dropout.length, 1e-6, 1e3).doc("s", "Mean length.");
              })
      .doc("Times without a new value.");
}

/// Keys of a sensor apply to all three of its channels. Keys under a channel's name override them
/// for this channel.
void describe_sensor(Fields& fields, SensorProfile& profile, const Sensor& sensor) {
  std::array<SensorChannel, 3>& channels = profile.*sensor.channels;
  const std::array<const char*, 3>& names = sensor.channel_names();
  const bool is_joint = sensor.kind == SensorKind::joint;
  const auto describe_channel = [&](Fields& one, SensorChannel& channel) {
    // The reference of keys lists those of a sensor once.
    if (one.documenting()) return;
    describe_values(one, channel, sensor);
    if (is_joint) describe_clock(one, channel);
  };
  const auto describe_all = [&](Fields& all) {
    const bool alike = channels[0] == channels[1] && channels[0] == channels[2];
    SensorChannel common = channels[0];
    if (all.reading() || alike) describe_values(all, common, sensor);
    if (all.reading() || alike || !is_joint) describe_clock(all, common);
    if (all.reading()) channels.fill(common);
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (!all.given(names[i], !alike)) continue;
      all.within(names[i], [&](Fields& one) { describe_channel(one, channels[i]); })
          .type(is_joint ? "section with the keys of its sensor"
                         : "section with the keys of its sensor but rate, delay and dropout")
          .doc("Replaces values of its sensor for this channel.");
    }
  };
  fields.within(sensor.name, describe_all).doc(sensor.meaning);
}

}  // namespace

SensorProfile with_value(SensorProfile profile, std::string_view key, double value) {
  for (double* number : numbers_of(profile, key)) *number = value;
  // Reading the profile back checks the range of the value.
  from_yaml<SensorProfile>(YamlDocument::parse(to_yaml(profile), fmt::format("{}={}", key, value)));
  return profile;
}

void describe(Fields& fields, SensorProfile& profile) {
  for (const Sensor& sensor : sensors) describe_sensor(fields, profile, sensor);
  const auto describe_misalignment = [&](Fields& misalignment) {
    constexpr double pi = std::numbers::pi;
    Misalignment& angle = profile.misalignment;
    misalignment("roll", angle.roll, -pi, pi).range("-π to π").doc("rad", "About x.");
    misalignment("pitch", angle.pitch, -pi, pi).range("-π to π").doc("rad", "About y, after roll.");
    misalignment("yaw", angle.yaw, -pi, pi).range("-π to π").doc("rad", "About z, after pitch.");
    misalignment("sd", angle.sd, 0.0, 1.0)
        .doc("rad", "Standard deviation of a draw per run that is added to each angle.");
  };
  fields.within("misalignment", describe_misalignment)
      .doc("Rotation of the IMU from its nominal frame.");
  fields("leg_skew", profile.leg_skew, 0.0, 1.0)
      .doc("s", "The right leg's joints are reported this much later than the left leg's.");
}

bool is_ideal(const SensorChannel& channel) {
  return channel.scale == Constant() && channel.bias == Constant() && channel.walk == 0.0 &&
         channel.vibration.amplitude == 0.0 && channel.mount.frequency == 0.0 &&
         channel.coloured.sd == 0.0 && channel.low_pass == 0.0 && channel.white == 0.0 &&
         std::isinf(channel.range) && channel.resolution == 0.0 && channel.rate == 0.0 &&
         channel.delay == 0.0 && channel.dropout.rate == 0.0;
}

bool is_ideal(const AxisChannels& channels) {
  return std::all_of(channels.begin(), channels.end(),
                     [](const SensorChannel& channel) { return is_ideal(channel); });
}

bool is_ideal(const SensorProfile& profile) {
  return is_ideal(profile.torque) && is_ideal(profile.position) && is_ideal(profile.velocity) &&
         is_ideal(profile.accelerometer) && is_ideal(profile.gyroscope) &&
         is_ideal(profile.orientation) && profile.misalignment == Misalignment() &&
         profile.leg_skew == 0.0;
}

SensorProfile find_sensor_profile(const std::filesystem::path& path) {
  return from_yaml<SensorProfile>(YamlDocument::load(find_resource(path)));
}

std::string to_yaml(const SensorProfile& profile) { return YAML::Dump(to_node(profile)) + "\n"; }

}  // namespace touchdown::noise
