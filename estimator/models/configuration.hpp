#pragma once

#include "estimator/bayes/config.hpp"
#include "estimator/force/load_filter.hpp"
#include "estimator/models/metadata.hpp"
#include "estimator/neural/estimator.hpp"
#include "estimator/signal_bounds.hpp"

namespace touchdown {

/// An estimator's configuration as text, without its sample rate and the settings of its fit.
ConfigurationText text_of(const BayesFilterConfig& config);
ConfigurationText text_of(const NeuralEstimatorConfig& config);
ConfigurationText text_of(const LoadFilterConfig& config);
/// Replaces the robot's part of a load filter's configuration.
void put_into(ConfigurationText& configuration, const LegGeometry& geometry);

/// The inverse. Members that the text lacks keep their values. Errors: `InputError` for an unknown
/// key, and for values of the wrong kind.
void configure(BayesFilterConfig& config, const ConfigurationText& text);
void configure(NeuralEstimatorConfig& config, const ConfigurationText& text);
void configure(LoadFilterConfig& config, const ConfigurationText& text);

/// The bounds of the robot's signals in a configuration, keys "bounds.velocity" and so on; the
/// defaults where it has none. Errors: `InputError` for values that are no bounds.
SignalBounds signal_bounds_of(const ConfigurationText& text);
/// Whether this is the key of a bound.
bool is_signal_bound(const std::string& key);

/// The configuration at another rate (Hz). The window of the transition model keeps its duration.
BayesFilterConfig at_rate(BayesFilterConfig config, double sample_rate);

}  // namespace touchdown
