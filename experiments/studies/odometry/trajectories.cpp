#include "experiments/studies/odometry/trajectories.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/results/odometry.hpp"
#include "experiments/studies/odometry/plan.hpp"

namespace touchdown::experiments {

namespace {

constexpr double spacing = 0.01;  // s
constexpr char end_of_text = '\0';

/// The scored part of a run as texts.
class Texts {
 public:
  explicit Texts(const MeasuredRun& run)
      : run_(run),
        first_(scoring::first_scored_step(run.signals.info.control_period_us, run.scoring)) {}

  bool is_empty() const { return first_ >= run_.signals.steps(); }

  std::string truth() const { return text(scored(run_.signals.motion->truth)); }

  std::string with_contact(const TrackView& p_contact) const {
    const scoring::Trajectory estimate =
        scored(dead_reckoned(run_.signals, run_.noise, run_.cells.front().levels(), p_contact));
    return text(scoring::aligned_at_start(estimate, run_.signals.motion->truth[first_]));
  }

 private:
  scoring::Trajectory scored(const scoring::Trajectory& whole) const {
    return {whole.begin() + static_cast<std::ptrdiff_t>(first_), whole.end()};
  }
  std::string text(const scoring::Trajectory& trajectory) const {
    const auto period = static_cast<double>(run_.signals.info.control_period_us);
    const auto stride =
        static_cast<std::size_t>(std::max(1LL, std::llround(1e6 * spacing / period)));
    return scoring::to_tum(trajectory, stride) + end_of_text;
  }

  const MeasuredRun& run_;
  std::size_t first_;
};

bool is_first_of_scene(const MeasuredRun& run, int runs) {
  return run.seed == 0 && run.signals.info.run % runs == 0;
}

}  // namespace

Measure trajectories(const OdometryStudyConfig& config, int runs) {
  Measure measure;
  measure.name = trajectory_measure;
  measure.of_run = [config, runs](const MeasuredRun& run) {
    const Texts texts(run);
    if (!is_first_of_scene(run, runs) || texts.is_empty()) return std::string();
    std::string all = texts.truth();
    for (const ContactTrack& track : oracle_tracks(config.delay, run.signals)) {
      all += texts.with_contact({track[0], track[1]});
    }
    return all;
  };
  measure.of_prediction = [runs](const MeasuredPrediction& made) {
    const Texts texts(made.run);
    const bool is_wanted = made.cell == 0 && made.condition.is_fitted_in_domain() &&
                           is_first_of_scene(made.run, runs) && !texts.is_empty();
    if (!is_wanted) return std::string();
    return texts.with_contact({made.prediction[0].p_contact, made.prediction[1].p_contact});
  };
  return measure;
}

void write_trajectories(const Evaluation& evaluation, const RunDirectory& directory) {
  const Plan& plan = evaluation.plan;
  for (const Task& task : plan.tasks) {
    const PlannedRun& run = plan.runs[task.run];
    if (run.group != 0 || task.seed != 0) continue;
    const std::optional<TaskCounts> counts = evaluation.saved.read(plan, task);
    if (!counts) throw Error(fmt::format("the results of {} are missing", task_name(plan, task)));
    std::string texts;
    for (const MeasuredBytes& found : counts->measured) {
      if (found.measure == trajectory_measure) texts += found.bytes;
    }
    if (texts.empty()) continue;
    std::vector<std::string> names =
        contact_sources_of(evaluation.request.experiment.studies.at<OdometryStudyConfig>(),
                           plan.groups.front(), run.simulator);
    names.insert(names.begin(), "ground_truth");
    std::size_t begin = 0;
    for (const std::string& name : names) {
      const std::size_t end = texts.find(end_of_text, begin);
      if (end == std::string::npos) throw Error("a state file is too short");
      write_atomically(directory.own_file("trajectories", fmt::format("{}_{}_{}.tum", run.simulator,
                                                                      run.scenario.name, name)),
                       texts.substr(begin, end - begin));
      begin = end + 1;
    }
  }
}

}  // namespace touchdown::experiments
