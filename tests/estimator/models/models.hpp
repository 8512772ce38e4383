#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "estimator/models/make_estimator.hpp"
#include "estimator/models/metadata.hpp"
#include "estimator/models/model.hpp"
#include "tests/estimator/named_config.hpp"
#include "tests/estimator/neural/sample.hpp"
#include "tests/estimator/synthetic.hpp"

namespace touchdown::test {

/// The arrays of a fit of the estimator of this name.
inline ModelArrays fitted_arrays(const std::string& name) {
  if (name == "nmn") return arrays_of(random_network(16, 16, 8));
  if (name == "load_filter") return {{std::string(estimator_array), array_of_text(name)}};
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

/// `drops` on bent legs, which show the loads of the wheels.
inline std::vector<Signals> drops_on_bent_legs(std::size_t steps) {
  std::vector<Signals> signals = drops(steps);
  for (Signals& s : signals) {
    for (const std::size_t side : {0U, 1U}) {
      const double sign = side == 0 ? 1.0 : -1.0;
      s.leg[side].hip.position = sign * 0.455;
      s.leg[side].knee.position = sign * -0.791;
    }
  }
  return signals;
}

}  // namespace touchdown::test
