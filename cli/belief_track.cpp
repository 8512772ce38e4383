#include "cli/belief_track.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "estimator/bayes_filter.hpp"
#include "experiments/estimator_registry.hpp"
#include "experiments/resources.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown {

BeliefTrack believe(const Condition& condition, const FittedModels& models, const HeardRun& run,
                    const UnitNoise& noise, const NoiseLevels& levels) {
  const auto estimator = make_estimator(condition, models, run.info.control_period_us);
  const auto* filter = dynamic_cast<const BayesFilter*>(estimator.get());
  BeliefTrack track;
  begin(*estimator, run);
  track.name = estimator_entry(condition.estimator).title;
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const Belief& belief = estimator->update(noisy(run, noise, levels, k));
    for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
      track.p_contact[wheel].push_back(static_cast<float>(belief.wheel[wheel].p_contact));
      if (filter == nullptr) continue;
      const auto& transition = filter->transition();
      track.p_takeoff[wheel].push_back(static_cast<float>(transition.contact_to_air));
      track.p_landing[wheel].push_back(static_cast<float>(transition.air_to_contact));
    }
  }
  return track;
}

Recording with_noise(Recording recording, const NoiseKey& key, const NoiseLevels& levels) {
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    recording.observation[k] = with_noise(recording.observation[k], key, k, levels);
  }
  return recording;
}

RobotModel robot_of(const Recording& recording) {
  const RecordingInfo& info = recording.info;
  if (info.scenario_yaml.empty()) {
    throw InputError(
        "the recording does not say on which terrain it was made: a robot's own log "
        "cannot be drawn");
  }
  const Scenario scenario =
      scenario_from_yaml(YamlDocument::parse(info.scenario_yaml, info.scenario + " (in the log)"));
  return compile_robot_model(find_resource(scenario.robot), scenario.terrain);
}

}  // namespace touchdown
