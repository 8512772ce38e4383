#include "experiments/plan/condition.hpp"

#include <fmt/format.h>

#include "core/random.hpp"
#include "experiments/estimators/registry.hpp"

namespace touchdown::experiments {

std::string model_key(const std::string& simulator, const std::string& fit, int refit) {
  return simulator + fit + (refit > 0 ? fmt::format("~{}", refit) : "");
}

bool is_of_refit(std::string_view model_key) { return model_key.find('~') != model_key.npos; }

std::vector<Condition> own_engine_conditions(const Experiment& experiment) {
  std::vector<Condition> conditions;
  for (const std::string& simulator : experiment.simulators) {
    for (const std::string& estimator : experiment.estimators) {
      if (estimator != always_contact_name) conditions.push_back({simulator, simulator, estimator});
    }
    conditions.push_back({simulator, simulator, std::string(always_contact_name)});
  }
  return conditions;
}

std::vector<Condition> tested_on(std::vector<Condition> conditions, const std::string& simulator) {
  std::erase_if(conditions, [&](const Condition& c) { return c.test_simulator != simulator; });
  return conditions;
}

noise::NoiseKey draws_of(std::uint64_t seed, std::uint64_t stream, std::uint64_t number,
                         std::int64_t run) {
  const auto bits = philox(seed, stream, number);
  return {.seed = (std::uint64_t{bits[0]} << 32U) | bits[1],
          .run = static_cast<std::uint64_t>(run)};
}

noise::NoiseKey noise_key(const Experiment& experiment, int noise_seed, std::int64_t run) {
  constexpr std::uint64_t noise_stream = 0x6e6f697365;  // "noise"
  return draws_of(experiment.seed, noise_stream, static_cast<std::uint64_t>(noise_seed), run);
}

Columns<noise::NoiseCell> noise_columns() {
  return Columns<noise::NoiseCell>()
      .level("torque_noise_nm", &noise::NoiseCell::torque)
      .level("accelerometer_noise_mps2", &noise::NoiseCell::accelerometer);
}

Columns<noise::NoiseCell> knee_wheel_columns() {
  return Columns<noise::NoiseCell>()
      .level("knee_noise_nm", &noise::NoiseCell::knee)
      .level("wheel_noise_nm", &noise::NoiseCell::wheel);
}

}  // namespace touchdown::experiments
