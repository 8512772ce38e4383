#include "experiments/studies/odometry/plan.hpp"

#include "experiments/results/odometry.hpp"

namespace touchdown::experiments {

namespace {

Measure scores_measure(const OdometryStudyConfig& config, const std::string& fit) {
  using Scores = std::vector<scoring::TrajectoryScore>;
  const auto score = [](const MeasuredRun& run, const TrackView& p_contact) {
    return score_odometry(run.signals, run.noise, run.cells.front().levels(), p_contact,
                          run.scoring);
  };
  Measure measure;
  measure.name = odometry_measure;
  measure.of_run = [config, score](const MeasuredRun& run) {
    Scores scores;
    for (const ContactTrack& track : oracle_tracks(config.delay, run.signals)) {
      scores.push_back(score(run, {track[0], track[1]}));
    }
    return to_bytes(scores);
  };
  measure.of_prediction = [fit, score](const MeasuredPrediction& made) {
    if (made.cell > 0 || !made.condition.is_fitted_in_domain(fit)) return std::string();
    return to_bytes(
        Scores{score(made.run, {made.prediction[0].p_contact, made.prediction[1].p_contact})});
  };
  measure.bytes_of_run = oracle_names(config.delay).size() * sizeof(scoring::TrajectoryScore);
  measure.bytes_of_prediction = sizeof(scoring::TrajectoryScore);
  return measure;
}

}  // namespace

std::vector<BenchmarkSetup> odometry_setups(const RunRequest& request, const Plan& plan) {
  if (request.experiment.studies.has<BenchmarkConfig>()) return benchmark_setups(request, plan);
  RunRequest alone = request;
  alone.experiment.studies.emplace<BenchmarkConfig>();
  return benchmark_setups(alone, plan);
}

void add_odometry_study(const RunRequest& request, Plan& plan) {
  const auto& config = request.experiment.studies.at<OdometryStudyConfig>();
  plan.needs_motion = true;
  for (const BenchmarkSetup& setup : odometry_setups(request, plan)) {
    RunGroup& group = plan.groups[setup.group];
    add_measure(scores_measure(config, group.fit), group);
  }
}

std::vector<std::string> contact_sources_of(const OdometryStudyConfig& config,
                                            const RunGroup& group, const std::string& simulator) {
  std::vector<std::string> names = oracle_names(config.delay);
  for (const Condition& condition : tested_on(group.conditions, simulator)) {
    if (condition.is_fitted_in_domain(group.fit)) {
      names.push_back(contact_name(condition.estimator));
    }
  }
  return names;
}

}  // namespace touchdown::experiments
