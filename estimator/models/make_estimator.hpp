#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "estimator/contact_estimator.hpp"
#include "estimator/models/metadata.hpp"
#include "estimator/models/model.hpp"

namespace touchdown {

/// Makes the estimator that a model was fitted for. A model without metadata, older or from another
/// program, is accepted if `use` names what the arrays do not: the sample rate and, of a grid, the
/// estimator.
/// Errors: `InputError`, one line, for missing arrays or metadata, for an estimator, rate or robot
/// other than the model's, for unknown members of the configuration, and for numbers that the
/// estimator refuses.
std::unique_ptr<ContactEstimator> make_estimator(const Model& model, const ModelUse& use = {});
std::unique_ptr<ContactEstimator> make_estimator(const ModelArrays& arrays,
                                                 const ModelUse& use = {});

/// The metadata that `make_estimator` uses. Errors: those of `make_estimator` about the metadata.
ModelMetadata metadata_for(const Model& model, const ModelUse& use = {});

/// The settings of an estimator that is made of a model.
struct EstimatorSettings {
  std::string estimator;     ///< one that shares the model's fit
  double sample_rate = 0.0;  ///< Hz
  /// Members that replace those of the estimator's default configuration.
  ConfigurationText configuration = {};
  double configured_rate = 0.0;  ///< at which windows in `configuration` count steps (Hz)
};

/// Makes an estimator of a model with these settings, whatever rates and robots the model serves.
/// Errors: `InputError` for a name of which no model is fitted, for another estimator's model, and
/// for settings that the estimator refuses.
std::unique_ptr<ContactEstimator> make_with(const Model& model, const EstimatorSettings& settings);

/// The default configuration of an estimator at this rate (Hz), on Upkie's legs. Errors:
/// `InputError` for a name of which no model is fitted.
ConfigurationText default_configuration(std::string_view estimator, double sample_rate);

/// Checks members of an estimator's configuration, beside the defaults of the others; those of an
/// estimator without a model are not looked at. Errors: `InputError` for an unknown key and for a
/// number beyond its range.
void check_configuration(std::string_view estimator, const ConfigurationText& text);

/// Writes `use` into the model's metadata, so that programs need not repeat it when they load the
/// model: the members of the configuration and, if `use` has legs, those, the mass and the robot's
/// name. The fitted numbers stay. A model without metadata gets them.
/// Errors: those of `make_estimator`, but legs may be another robot's; `InputError` for legs and an
/// estimator that uses none.
Model model_for(Model model, const ModelUse& use);

/// The model of `LoadFilter` for a robot: its geometry alone. Errors: `InputError` for a rate that
/// is not positive.
Model load_filter_model(const LegGeometry& legs, double sample_rate, const std::string& robot);

/// Whether both estimators use the same fit.
bool share_fit(std::string_view estimator, std::string_view other);

/// One array of a model that is compiled into a program; `touchdown convert model.npz -o model.hpp`
/// writes them. Exactly one of the last three members is set.
struct CompiledArray {
  const char* name;
  std::size_t rows;
  std::size_t columns;  ///< 0: the array has one axis
  const double* doubles;
  const float* floats;  ///< where single precision holds all bits
  const char* text;     ///< of `rows` bytes
};

/// The arrays as they were in the file.
ModelArrays arrays_of(std::span<const CompiledArray> model);

/// Makes the estimator of a compiled model. Its beliefs are to the bit those of the model's file.
/// Errors: as `make_estimator` of arrays.
std::unique_ptr<ContactEstimator> make_estimator(std::span<const CompiledArray> model,
                                                 const ModelUse& use = {});

}  // namespace touchdown
