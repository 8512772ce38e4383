#include "experiments/evaluation/scenes.hpp"

#include <algorithm>

namespace touchdown::experiments {

std::vector<std::size_t> runs_in_scene(const Plan& plan, const Experiment& experiment,
                                       std::size_t group, std::size_t scene) {
  std::vector<std::size_t> runs = plan.runs_in(group);
  std::erase_if(runs,
                [&](std::size_t run) { return scene_of(plan.runs[run], experiment) != scene; });
  return runs;
}

std::vector<CollectedCounts> counts_by_scene(const Evaluation& evaluation, std::size_t group) {
  const Experiment& experiment = evaluation.request.experiment;
  std::vector<CollectedCounts> scenes;
  for (std::size_t scene = 0; scene < experiment.test.scenarios.size(); ++scene) {
    scenes.push_back(collect(evaluation.plan,
                             runs_in_scene(evaluation.plan, experiment, group, scene),
                             evaluation.saved));
  }
  return scenes;
}

std::vector<std::vector<scoring::Classification>> points_by_fit(const CollectedCounts& counts,
                                                                Condition condition,
                                                                std::size_t cell) {
  std::vector<std::vector<scoring::Classification>> fits;
  for (const ConditionScores& scored : counts.scored) {
    if (!(scored.condition == condition)) continue;
    std::vector<scoring::Classification>& points = fits.emplace_back();
    for (const scoring::RobotScore& run : scored.samples[cell]) {
      points.push_back(run.wheels().points);
    }
    ++condition.refit;
  }
  return fits;
}

std::uint64_t stream_of(std::size_t scene, const std::string& simulator,
                        const Experiment& experiment) {
  const std::vector<std::string>& engines = experiment.simulators;
  const auto engine = std::find(engines.begin(), engines.end(), simulator) - engines.begin();
  return scene * engines.size() + static_cast<std::size_t>(engine);
}

}  // namespace touchdown::experiments
