#pragma once

#include <string>

#include "estimator/models/make_estimator.hpp"
#include "estimator/models/model.hpp"
#include "estimator/models/parameters.hpp"
#include "tests/estimator/decision/random_model.hpp"
#include "tests/estimator/evidence/random_curves.hpp"
#include "tests/estimator/named_config.hpp"
#include "tests/estimator/neural/sample.hpp"
#include "tests/estimator/phase/synthetic.hpp"
#include "tests/estimator/synthetic.hpp"

namespace touchdown::test {

/// The arrays of a fit of the estimator of this name.
inline ModelArrays fitted_arrays(const std::string& name) {
  const auto of_parameters = [&](const Parameters& parameters) {
    ModelArrays arrays;
    for (const auto& [key, values] : parameters) arrays[key] = {{values.size()}, values};
    arrays[std::string(estimator_array)] = array_of_text(name);
    return arrays;
  };
  if (name == "phase" || name.starts_with("hmm")) return arrays_of(small_phase_model());
  if (name == "nmn") return arrays_of(random_network(16, 16, 8));
  if (name == "force_kinematics") {
    // Wide deviations, so that no belief rounds to one.
    return of_parameters(parameters_of(ForceKinematicsModel{
        .air = {.force_mean = 0.3, .force_deviation = 20.0},
        .contact = {.force_mean = 26.0, .force_deviation = 20.0, .leaving_rate = 0.7}}));
  }
  if (name == "decision_network") return of_parameters(parameters_of(random_model(3)));
  if (name.starts_with("evidence_curves")) return of_parameters(parameters_of(random_curves(3)));
  const BayesFilterConfig config = named(name == "measurement_only" ? "robust" : name);
  MeasurementConfig measurement = config.measurement;
  measurement.fit.knee_count = measurement.fit.wheel_count = 40;
  const auto samples = labelled(drops(3000), measurement.torque);
  return arrays_of(fit_measurement_model(samples.contact, samples.no_contact, measurement.fit));
}

/// As above, with the metadata of a fit at 1 kHz.
inline ModelArrays fitted_model(const std::string& name, const std::string& robot = "upkie") {
  ModelArrays arrays = fitted_arrays(name);
  add_metadata(arrays, {.estimator = name,
                        .sample_rate = 1000.0,
                        .robot = robot,
                        .configuration = default_configuration(name, 1000.0),
                        .fingerprint = {}});
  return arrays;
}

}  // namespace touchdown::test
