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

/// What a model says about itself.
struct ModelMetadata {
  std::string estimator;     ///< whom it was fitted for
  double sample_rate = 0.0;  ///< of what it was fitted to (Hz)
  /// That it was fitted to, or whose legs it was told since (model_for.hpp); empty where nobody
  /// knows.
  std::string robot;
  ConfigurationText configuration;  ///< that the estimator is run with
  /// A name for all of this and the model's numbers, sixteen hexadecimal digits: equal for equal
  /// fits.
  std::string fingerprint;

  bool operator==(const ModelMetadata&) const = default;
};

/// The array that holds the passport, as the bytes of "key: value" lines: format, units (SI
/// throughout), the members of the above, the configuration's keys after "configuration.".
inline constexpr std::string_view metadata_array = "metadata";

/// The array of a grid file that follows from the others: no reader needs it, no fingerprint counts
/// it.
inline constexpr std::string_view derived_array = "P_contact";

/// Adds the passport to the model's arrays, with their fingerprint. Returns the fingerprint.
std::string add_metadata(ModelArrays& arrays, const ModelMetadata& metadata);

/// The passport among a model's arrays; nothing in a file that is older than passports, or comes
/// from elsewhere. Errors: `InputError` for another format or other units, a line that nobody
/// understands, and for numbers that are not those that the passport was made for.
std::optional<ModelMetadata> metadata_of(const ModelArrays& arrays);

/// What a program expects of a model; what is left empty or zero is taken as the model has it.
struct ModelUse {
  std::string estimator = {};
  double sample_rate = 0.0;  ///< at which `update` will be called (Hz)
  std::string robot = {};
  /// The legs, for estimators that use kinematics.
  std::optional<LegGeometry> geometry = {};
  /// Members of the configuration that shall not be as the model has them.
  ConfigurationText configuration = {};
};

/// Errors: `InputError` that says what was expected and what the model was fitted for, if its rate
/// or robot is another one. A model that does not know its robot is any robot's.
void check_use(const ModelMetadata& metadata, const ModelUse& use);

}  // namespace touchdown
