#include "experiments/signals/estimator_runner.hpp"

namespace touchdown::experiments {

namespace {

/// Lets the templates below take an `EstimatorRunner` like a `ContactEstimator`.
template <typename Sense, typename Take>
void evaluate(EstimatorRunner& runner, const RunSignals& run, const Sense& sense,
              const Take& take) {
  runner.run_estimator(run, sense, take);
}

template <typename Estimator>
std::array<scoring::ContactSequence, models::wheel_count> decisions_of(
    Estimator& estimator, const RunSignals& run, const NoiseRun& noise,
    const noise::SensorNoise& levels) {
  std::array<scoring::ContactSequence, models::wheel_count> contact;
  contact.fill(scoring::ContactSequence(run.steps()));
  evaluate(
      estimator, run, [&](std::size_t k) { return noisy(run, noise, levels, k); },
      [&](std::size_t k, const Belief& belief) {
        contact[0][k] = std::uint8_t{belief.wheel[0].contact};
        contact[1][k] = std::uint8_t{belief.wheel[1].contact};
      });
  return contact;
}

template <typename Estimator>
scoring::Prediction prediction_of(Estimator& estimator, const RunSignals& run,
                                  const NoiseRun& noise, const noise::SensorNoise& levels) {
  scoring::Prediction prediction;
  prediction.fill({.contact = scoring::ContactSequence(run.steps()),
                   .p_contact = std::vector<double>(run.steps())});
  evaluate(
      estimator, run, [&](std::size_t k) { return noisy(run, noise, levels, k); },
      [&](std::size_t k, const Belief& belief) {
        const auto views = scoring::views_of(belief);
        for (std::size_t v = 0; v < scoring::view_count; ++v) {
          prediction[v].contact[k] = std::uint8_t{views[v].contact};
          prediction[v].p_contact[k] = views[v].p_contact;
        }
      });
  return prediction;
}

}  // namespace

std::array<scoring::ContactSequence, models::wheel_count> decide(ContactEstimator& estimator,
                                                                 const RunSignals& run,
                                                                 const NoiseRun& noise,
                                                                 const noise::SensorNoise& levels) {
  return decisions_of(estimator, run, noise, levels);
}

std::array<scoring::ContactSequence, models::wheel_count> decide(EstimatorRunner& runner,
                                                                 const RunSignals& run,
                                                                 const NoiseRun& noise,
                                                                 const noise::SensorNoise& levels) {
  return decisions_of(runner, run, noise, levels);
}

scoring::Prediction predict(ContactEstimator& estimator, const RunSignals& run,
                            const NoiseRun& noise, const noise::SensorNoise& levels) {
  return prediction_of(estimator, run, noise, levels);
}

scoring::Prediction predict(EstimatorRunner& runner, const RunSignals& run, const NoiseRun& noise,
                            const noise::SensorNoise& levels) {
  return prediction_of(runner, run, noise, levels);
}

}  // namespace touchdown::experiments
