#pragma once

#include "estimator/bayes/config.hpp"
#include "estimator/decision/config.hpp"
#include "estimator/force/force_kinematics.hpp"
#include "estimator/force/load_logistic.hpp"
#include "estimator/models/metadata.hpp"
#include "estimator/neural/estimator.hpp"
#include "estimator/phase/config.hpp"

namespace touchdown {

/// What an estimator is run with, as text: all but its sample rate and how it is fitted, which its
/// model already is.
ConfigurationText text_of(const BayesFilterConfig& config);
ConfigurationText text_of(const PhaseFilterConfig& config);
ConfigurationText text_of(const NeuralEstimatorConfig& config);
ConfigurationText text_of(const LoadLogisticConfig& config);
ConfigurationText text_of(const ForceKinematicsConfig& config);
ConfigurationText text_of(const DecisionConfig& config);
/// What the configuration of an estimator that uses kinematics says of a robot, or a part of this.
ConfigurationText text_of(const LegGeometry& geometry);

/// The inverse; what the text does not say stays as it is. Errors: `InputError` for a key that is
/// not known, and for values of the wrong kind.
void configure(BayesFilterConfig& config, const ConfigurationText& text);
void configure(PhaseFilterConfig& config, const ConfigurationText& text);
void configure(NeuralEstimatorConfig& config, const ConfigurationText& text);
void configure(LoadLogisticConfig& config, const ConfigurationText& text);
void configure(ForceKinematicsConfig& config, const ConfigurationText& text);
void configure(DecisionConfig& config, const ConfigurationText& text);

/// The configuration at another rate (Hz): the window of the transition model lasts as long.
BayesFilterConfig at_rate(BayesFilterConfig config, double sample_rate);

}  // namespace touchdown
