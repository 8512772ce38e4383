#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "estimator/force/leg_geometry.hpp"
#include "estimator/models/arrays.hpp"

namespace touchdown {

/// A configuration as text: keys with dots, and values.
using ConfigurationText = std::map<std::string, std::string>;

/// What a model's file states about the model.
struct ModelMetadata {
  std::string estimator;     ///< the estimator that it was fitted for
  double sample_rate = 0.0;  ///< of the fitted runs (Hz)
  /// The robot that it was fitted to, or that `model_for` adapted it to; empty if unknown.
  std::string robot;
  ConfigurationText configuration;  ///< of the estimator
  /// Sixteen hexadecimal digits that identify all of this and the model's numbers: equal for equal
  /// fits.
  std::string fingerprint;

  bool operator==(const ModelMetadata&) const = default;
};

/// The array that holds the metadata, as the bytes of "key: value" lines: format, units (SI
/// throughout), the members of the above, the configuration's keys after "configuration.".
inline constexpr std::string_view metadata_array = "metadata";

/// The estimator whose model is the robot's geometry alone, in its configuration, and the array of
/// such a model: its bytes are this name.
inline constexpr std::string_view load_filter_name = "load_filter";
inline constexpr std::string_view estimator_array = "estimator";
/// The array with the origin of a model, as the bytes of "key: value" lines.
inline constexpr std::string_view provenance_array = "provenance";
/// Whether an array of this name is a text about the model.
constexpr bool is_text_array(std::string_view name) noexcept {
  return name == estimator_array || name == provenance_array || name == metadata_array;
}

/// The array of a grid file that follows from the others. Readers do not need it, and the
/// fingerprint leaves it out.
inline constexpr std::string_view derived_array = "P_contact";

/// Adds the metadata to the model's arrays, with their fingerprint. Returns the fingerprint.
std::string add_metadata(ModelArrays& arrays, const ModelMetadata& metadata);

/// Reads the metadata among a model's arrays; nothing if the file has none, being older or from
/// another program. Errors: `InputError` for another format or other units, an unknown line, and
/// numbers that do not match the fingerprint.
std::optional<ModelMetadata> metadata_of(const ModelArrays& arrays);

/// What a program requires of a model. Empty or zero: no requirement, the model decides.
struct ModelUse {
  std::string estimator = {};
  double sample_rate = 0.0;  ///< rate at which the program calls `update` (Hz)
  std::string robot = {};
  /// The legs, for estimators that use kinematics.
  std::optional<LegGeometry> geometry = {};
  /// Members of the configuration that replace the model's.
  ConfigurationText configuration = {};
};

/// Errors: `InputError` for a rate that is neither 0 nor a positive finite number.
void check_sample_rate(const ModelUse& use);

/// Whether two rates are equal: clocks of one robot differ from day to day.
bool is_same_rate(double rate, double other);

/// Errors: `InputError` as above, if the model does not serve the required rate, or the robot
/// differs from the model's; the message names both. A model without a robot fits any robot.
void check_use(const ModelMetadata& metadata, const ModelUse& use);

}  // namespace touchdown
