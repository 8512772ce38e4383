#include "estimator/models/configuration.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <span>
#include <type_traits>

#include "core/error.hpp"
#include "estimator/numerics/number_text.hpp"

namespace touchdown {

namespace {

using Names = std::span<const char* const>;

/// Writes each visited member under its key.
class MemberWriter {
 public:
  void operator()(const std::string& key, const double& value) { text[key] = text_of(value); }
  void operator()(const std::string& key, const int& value) { text[key] = std::to_string(value); }
  void operator()(const std::string& key, const bool& value) {
    text[key] = value ? "true" : "false";
  }
  template <typename Enum>
  void choose(const std::string& key, Names names, const Enum& value) {
    text[key] = names[static_cast<std::size_t>(value)];
  }

  ConfigurationText text;
};

/// Reads each visited member from its key, if the key exists.
class MemberReader {
 public:
  explicit MemberReader(const ConfigurationText& text) : left_(text) {}

  void operator()(const std::string& key, double& value) {
    take(key, [&](const std::string& text) {
      constexpr double largest = 1e15;  // beyond any quantity
      const std::optional<double> number = number_of(text);
      if (!number || std::abs(*number) > largest) return false;
      value = *number;
      return true;
    });
  }
  void operator()(const std::string& key, int& value) {
    take(key, [&](const std::string& text) {
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      return error == std::errc{} && end == text.data() + text.size();
    });
  }
  void operator()(const std::string& key, bool& value) {
    take(key, [&](const std::string& text) {
      value = text == "true";
      return value || text == "false";
    });
  }
  template <typename Enum>
  void choose(const std::string& key, Names names, Enum& value) {
    take(key, [&](const std::string& text) {
      const auto found = std::find(names.begin(), names.end(), text);
      if (found == names.end()) return false;
      value = static_cast<Enum>(found - names.begin());
      return true;
    });
  }

  /// Errors: `InputError` for a key without a member.
  void finish() const {
    if (left_.empty()) return;
    throw InputError("metadata: configuration." + left_.begin()->first +
                     ": is not known: was it written by a newer version?");
  }

 private:
  template <typename Read>
  void take(const std::string& key, const Read& read) {
    const auto found = left_.find(key);
    if (found == left_.end()) return;
    if (!read(found->second)) {
      throw InputError("metadata: configuration." + key + ": '" + found->second +
                       "' is no value for it");
    }
    left_.erase(found);
  }

  ConfigurationText left_;
};

// These functions visit every member once; `visit` writes or reads it. They are the only
// description of these structs. `core/fields` describes those of YAML files, with yaml-cpp; this
// library needs Eigen alone, and its texts are the metadata of models.

template <typename Visit, typename Guard>
void visit_guard(Visit& visit, Guard& guard) {
  visit("guard.maximum_gap", guard.maximum_gap);
  visit("guard.frozen_after", guard.frozen_after);
  visit("guard.largest_acceleration", guard.largest_acceleration);
  visit("guard.largest_torque", guard.largest_torque);
  visit("guard.relaxation", guard.relaxation);
}

template <typename Visit, typename Bounds>
void visit_bounds(Visit& visit, Bounds& bounds) {
  visit("bounds.leg_position", bounds.leg_position);
  visit("bounds.wheel_position", bounds.wheel_position);
  visit("bounds.velocity", bounds.velocity);
  visit("bounds.torque", bounds.torque);
  visit("bounds.acceleration", bounds.acceleration);
  visit("bounds.angular_velocity", bounds.angular_velocity);
  visit("bounds.ground_velocity", bounds.ground_velocity);
}

constexpr std::array<const char*, 2> signs = {"absolute", "mirrored"};
constexpr std::array<const char*, 3> powers = {"mean_square", "energy", "root_mean_square"};
constexpr std::array<const char*, 2> spectra = {"power", "magnitude"};
static_assert(static_cast<int>(TorqueSign::mirrored) == 1 &&
              static_cast<int>(PowerMeasure::root_mean_square) == 2 &&
              static_cast<int>(SpectrumKind::magnitude) == 1);

template <typename Visit, typename Config>
requires std::same_as<std::remove_const_t<Config>, BayesFilterConfig>
void visit_members(Visit& visit, Config& config) {
  visit.choose("torque.sign", signs, config.measurement.torque.sign);
  visit("torque.low_pass", config.measurement.torque.low_pass);
  visit("contact_floor", config.measurement.contact_floor);
  visit("no_contact_floor", config.measurement.no_contact_floor);
  // Models with densities that stay as fitted do not have these keys.
  auto& noise = config.measurement.noise;
  if (!std::is_const_v<Config> || noise.is_followed) {
    visit("noise.is_followed", noise.is_followed);
    visit("noise.share", noise.share);
    visit("noise.floor", noise.floor);
    visit("noise.ceiling", noise.ceiling);
    visit("noise.gain", noise.gain);
    visit("noise.warm_up", noise.warm_up);
  }
  auto& transition = config.transition;
  visit("transition.window", transition.window);
  visit.choose("transition.power", powers, transition.power);
  visit.choose("transition.median_of", spectra, transition.median_of);
  visit("transition.nyquist", transition.nyquist);
  visit("transition.switch.offset", transition.switch_sigmoid.offset);
  visit("transition.switch.slope", transition.switch_sigmoid.slope);
  visit("transition.landing.offset", transition.landing_sigmoid.offset);
  visit("transition.landing.slope", transition.landing_sigmoid.slope);
  visit("transition.margin", transition.margin);
  visit("transition.median_memory", transition.median_memory);
  visit("transition.row_stochastic", transition.row_stochastic);
  visit("threshold", config.threshold);
  visit_guard(visit, config.guard);
}

template <typename Visit, typename Config>
requires std::same_as<std::remove_const_t<Config>, NeuralEstimatorConfig>
void visit_members(Visit& visit, Config& config) {
  visit("threshold", config.threshold);
  visit_guard(visit, config.guard);
}

template <typename Visit, typename Geometry>
requires std::same_as<std::remove_const_t<Geometry>, LegGeometry>
void visit_members(Visit& visit, Geometry& geometry) {
  visit("geometry.upper_length", geometry.upper_length);
  visit("geometry.lower_length", geometry.lower_length);
  visit("geometry.upper_mass", geometry.upper_mass);
  visit("geometry.lower_mass", geometry.lower_mass);
  visit("geometry.wheel_mass", geometry.wheel_mass);
  visit("geometry.upper_centre", geometry.upper_centre);
  visit("geometry.lower_centre", geometry.lower_centre);
  visit("geometry.upper_inertia", geometry.upper_inertia);
  visit("geometry.lower_inertia", geometry.lower_inertia);
  visit("geometry.hip_armature", geometry.hip_armature);
  visit("geometry.knee_armature", geometry.knee_armature);
  visit("geometry.wheel_armature", geometry.wheel_armature);
  visit("geometry.hip_viscous", geometry.hip_viscous);
  visit("geometry.knee_viscous", geometry.knee_viscous);
  visit("geometry.wheel_viscous", geometry.wheel_viscous);
  visit("geometry.hip_torque_limit", geometry.hip_torque_limit);
  visit("geometry.knee_torque_limit", geometry.knee_torque_limit);
  visit("geometry.wheel_torque_limit", geometry.wheel_torque_limit);
  visit("geometry.hip_forward", geometry.hip_forward);
  visit("geometry.hip_upward", geometry.hip_upward);
  visit("geometry.leg_sideways", geometry.leg_sideways);
  visit("wheel_inertia", geometry.wheel_inertia);
  visit("robot_mass", geometry.robot_mass);
  visit("hip_friction", geometry.hip_friction);
  visit("knee_friction", geometry.knee_friction);
}

template <typename Visit, typename Config>
requires std::same_as<std::remove_const_t<Config>, LoadFilterConfig>
void visit_members(Visit& visit, Config& config) {
  visit_members(visit, config.geometry);
  visit("lead", config.lead);
  visit("leave_below", config.leave_below);
  visit("return_above", config.return_above);
  visit_guard(visit, config.guard);
}

template <typename Config>
ConfigurationText written(const Config& config) {
  MemberWriter writer;
  visit_members(writer, config);
  return writer.text;
}

template <typename Config>
void read(Config& config, const ConfigurationText& text) {
  MemberReader reader(text);
  visit_members(reader, config);
  SignalBounds of_robot;  // `signal_bounds_of` reads these
  visit_bounds(reader, of_robot);
  reader.finish();
}

}  // namespace

ConfigurationText text_of(const BayesFilterConfig& config) { return written(config); }
ConfigurationText text_of(const NeuralEstimatorConfig& config) { return written(config); }
ConfigurationText text_of(const LoadFilterConfig& config) { return written(config); }

void put_into(ConfigurationText& configuration, const LegGeometry& geometry) {
  for (auto& [key, value] : written(geometry)) configuration[key] = value;
}

void configure(BayesFilterConfig& config, const ConfigurationText& text) { read(config, text); }
void configure(NeuralEstimatorConfig& config, const ConfigurationText& text) { read(config, text); }
void configure(LoadFilterConfig& config, const ConfigurationText& text) { read(config, text); }
SignalBounds signal_bounds_of(const ConfigurationText& text) {
  SignalBounds bounds;
  MemberReader reader(text);
  visit_bounds(reader, bounds);
  check_signal_bounds(bounds);
  return bounds;
}

bool is_signal_bound(const std::string& key) {
  static const ConfigurationText all = [] {
    MemberWriter writer;
    const SignalBounds defaults;
    visit_bounds(writer, defaults);
    return writer.text;
  }();
  return all.contains(key);
}

BayesFilterConfig at_rate(BayesFilterConfig config, double sample_rate) {
  config.transition.window = std::max(
      2,
      static_cast<int>(std::lround(config.transition.window * sample_rate / config.sample_rate)));
  config.sample_rate = sample_rate;
  return config;
}

}  // namespace touchdown
