#include "render/pictures/belief_track.hpp"

#include <cmath>

#include "experiments/estimators/registry.hpp"
#include "experiments/fitting/make_estimator.hpp"

namespace touchdown::render {

BeliefTrack believe(const experiments::Condition& condition,
                    const experiments::FittedModels& models, const experiments::RunSignals& run,
                    const experiments::NoiseRun& noise, const noise::SensorNoise& levels) {
  const auto estimator = experiments::make_estimator(condition, models, run);
  BeliefTrack track;
  track.name = experiments::estimator_entry(condition.estimator).title;
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const Belief& belief = estimator->update(experiments::noisy(run, noise, levels, k));
    const Evidence::Transition transition = estimator->evidence().transition;
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      track.p_contact[wheel].push_back(static_cast<float>(belief.wheel[wheel].p_contact));
      if (std::isnan(transition.p_takeoff)) continue;
      track.p_takeoff[wheel].push_back(static_cast<float>(transition.p_takeoff));
      track.p_landing[wheel].push_back(static_cast<float>(transition.p_landing));
    }
  }
  return track;
}

}  // namespace touchdown::render
