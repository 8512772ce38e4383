#include "experiments/studies/sensor_sweep/config.hpp"

#include "noise/sensor_profile.hpp"
#include "experiments/config/experiment_yaml.hpp"

namespace touchdown::experiments {

/// A mapping of keys to lists of values.
static void describe(Fields& fields, SensorSweepConfig& config, const Experiment& /*experiment*/) {
  std::vector<SensorFactor>& factors = config.factors;
  if (fields.documenting()) factors = {{"SENSOR.DISTURBANCE", {}}};
  if (fields.reading()) {
    for (const auto& entry : fields.node()) factors.push_back({entry.first.as<std::string>(), {}});
  }
  for (SensorFactor& factor : factors) {
    fields.in_line(factor.key, factor.values)
        .fallback("none")
        .doc("Values of a disturbance of the sensors, such as `torque.bias` or `delay`.");
    fields.check(!factor.values.empty(), factor.key, "expected at least one number");
    fields.check(factor.key, [&] {
      for (const double value : factor.values) noise::with_value({}, factor.key, value);
    });
  }
}

StudySection sensor_sweep_section() {
  StudySection section = optional_section<SensorSweepConfig>(
      "sweep", "Disturbances of the sensors that are varied, one at a time.");
  section.before = "noise";
  section.describe = [describe_config = section.describe](Fields& fields, Experiment& experiment) {
    describe_config(fields, experiment);
    const auto* const config = experiment.studies.find<SensorSweepConfig>();
    if (config != nullptr && config->factors.empty()) {
      experiment.studies.erase<SensorSweepConfig>();
    }
  };
  return section;
}

}  // namespace touchdown::experiments
