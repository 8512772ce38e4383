#pragma once

#include <memory>
#include <string_view>

#include "estimator/contact_estimator.hpp"
#include "estimator/models/metadata.hpp"

namespace touchdown {

/// Makes the estimator that a model was fitted for. A model without metadata, older or from another
/// program, is accepted if `use` names what the arrays do not: the estimator of a grid, and the
/// sample rate of all models but a phase model.
/// Errors: `InputError`, one line, for missing arrays or metadata, for an estimator, rate or robot
/// other than the model's, for unknown members of the configuration, and for numbers that the
/// estimator refuses.
std::unique_ptr<ContactEstimator> make_estimator(const ModelArrays& arrays,
                                                 const ModelUse& use = {});

/// The metadata that `make_estimator` uses. Errors: those of `make_estimator` about the metadata.
ModelMetadata metadata_for(const ModelArrays& arrays, const ModelUse& use = {});

/// The default configuration of an estimator at this rate (Hz), on a robot with these legs, with
/// a model that has the load by the servo law, if the estimator can have it. Errors: `InputError`
/// for a name of which no model is fitted.
ConfigurationText default_configuration(std::string_view estimator, double sample_rate,
                                        const LegGeometry& legs = {}, bool servo_load = false);

/// Whether this library makes an estimator of this name from a model. Experiments have others, too.
bool makes_estimator(std::string_view name);

/// Whether both estimators use the same fit.
bool share_fit(std::string_view estimator, std::string_view other);

}  // namespace touchdown
