#include "experiments/signals/estimator_runner.hpp"

namespace touchdown::experiments {

std::array<scoring::ContactSequence, models::wheel_count> decide(const EstimatorRunner& runner,
                                                                 const RunSignals& run,
                                                                 const NoiseRun& noise,
                                                                 const noise::SensorNoise& levels) {
  std::array<scoring::ContactSequence, models::wheel_count> contact;
  contact.fill(scoring::ContactSequence(run.steps()));
  runner.run_estimator(
      run, [&](std::size_t k) { return noisy(run, noise, levels, k); },
      [&](std::size_t k, const Belief& belief) {
        contact[0][k] = std::uint8_t{belief.wheel[0].contact};
        contact[1][k] = std::uint8_t{belief.wheel[1].contact};
      });
  return contact;
}

scoring::Prediction predict(const EstimatorRunner& runner, const RunSignals& run,
                            const NoiseRun& noise, const noise::SensorNoise& levels) {
  scoring::Prediction prediction;
  runner.run_estimator(
      run, [&](std::size_t k) { return noisy(run, noise, levels, k); },
      [&](std::size_t /*k*/, const Belief& belief) { scoring::add_step(prediction, belief); });
  return prediction;
}

}  // namespace touchdown::experiments
