#include "estimator/bayes/config.hpp"

namespace touchdown {

BayesFilterConfig BayesFilterConfig::paper() {
  BayesFilterConfig config;
  config.measurement.torque = {TorqueSign::absolute, 0.0};
  config.measurement.fit.knee_range = {0.0, 3.0};
  config.measurement.fit.wheel_range = {0.0, 0.75};
  config.transition.power = PowerMeasure::mean_square;
  config.transition.median_of = SpectrumKind::power;
  config.transition.nyquist = true;
  config.transition.switch_sigmoid = {8.0, 1.0};
  config.transition.landing_sigmoid = {7.5, 2.5};
  config.transition.margin = 0.0;
  config.transition.median_memory = 0.0;
  config.transition.row_stochastic = false;
  return config;
}

BayesFilterConfig BayesFilterConfig::paper_rms() {
  BayesFilterConfig config = paper();
  config.transition.power = PowerMeasure::root_mean_square;
  return config;
}

BayesFilterConfig BayesFilterConfig::reference() {
  BayesFilterConfig config;
  config.measurement.torque = {TorqueSign::mirrored, 0.025};
  config.measurement.fit.knee_range = {0.0, 3.0};
  config.measurement.fit.wheel_range = {0.0, 0.75};
  config.measurement.contact_floor = 1e-20;
  config.transition.power = PowerMeasure::mean_square;
  config.transition.median_of = SpectrumKind::magnitude;
  config.transition.nyquist = false;
  config.transition.switch_sigmoid = {50.0, 5.0};
  config.transition.landing_sigmoid = {8.0, 3.0};
  config.transition.margin = 1e-10;
  config.transition.median_memory = 0.1;
  config.transition.row_stochastic = false;
  return config;
}

BayesFilterConfig BayesFilterConfig::robust() {
  BayesFilterConfig config = reference();
  config.measurement.torque.sign = TorqueSign::absolute;
  config.measurement.fit.knee_range.reset();
  config.measurement.fit.wheel_range.reset();
  // The servos' resolution. Noise that the fitted runs lack widens the densities while the filter
  // runs.
  config.measurement.fit.bandwidth_floor = {0.01, 0.01};
  config.measurement.noise.is_followed = true;
  config.transition.median_of = SpectrumKind::power;
  config.transition.nyquist = true;
  config.transition.row_stochastic = true;
  return config;
}

}  // namespace touchdown
