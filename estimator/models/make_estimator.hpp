#pragma once

#include <memory>
#include <string_view>

#include "estimator/contact_estimator.hpp"
#include "estimator/models/metadata.hpp"

namespace touchdown {

/// The estimator that a model was fitted for, ready to listen. A model that has no passport, older
/// than these or from elsewhere, is taken as well if `use` says what it does not: the estimator of
/// a grid, and the sample rate of all but a phase model.
/// Errors: `InputError`, one line: what is missing; an estimator, a rate or a robot that is not the
/// model's; a configuration without such a member; numbers that the estimator cannot be made with.
std::unique_ptr<ContactEstimator> make_estimator(const ModelArrays& arrays,
                                                 const ModelUse& use = {});

/// The passport that `make_estimator` goes by. Errors: those of it that are about the passport.
ModelMetadata metadata_for(const ModelArrays& arrays, const ModelUse& use = {});

/// What an estimator is run with at this rate (Hz), on a robot with these legs, unless somebody
/// says otherwise. Errors: `InputError` for a name that no model is fitted for.
ConfigurationText default_configuration(std::string_view estimator, double sample_rate,
                                        const LegGeometry& legs = {});

/// Whether this library makes an estimator of this name from a model: studies have others.
bool makes_estimator(std::string_view name);

/// Whether what was fitted for one estimator fits the other, too.
bool share_fit(std::string_view estimator, std::string_view other);

}  // namespace touchdown
