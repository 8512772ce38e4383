#include "experiments/studies/operating_points/rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "core/rows.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/studies/operating_points/config.hpp"
#include "experiments/studies/operating_points/plan.hpp"

namespace touchdown::experiments {

namespace {

/// Scores of one estimator in one noise setting: its own decisions, then the operating points.
using PointScores = std::vector<scoring::OperatingScore>;

/// The scores of a scene in one engine, by condition and cell; empty without scored runs.
std::map<std::pair<std::uint32_t, std::uint32_t>, PointScores> scores_of(
    const Evaluation& evaluation, std::size_t scene, const std::string& simulator) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, PointScores> sums;
  for (const std::size_t index : evaluation.plan.runs_in(0)) {
    const PlannedRun& run = evaluation.plan.runs[index];
    const bool is_in_scene =
        run.simulator == simulator && scene_of(run, evaluation.request.experiment) == scene;
    if (!is_in_scene) continue;
    for (const auto& found : measured<scoring::OperatingScore>(operating_points_name, index,
                                                               evaluation.plan, evaluation.saved)) {
      PointScores& sum = sums[{found.condition, found.cell}];
      sum.resize(found.scores.size());
      for (std::size_t i = 0; i < found.scores.size(); ++i) sum[i] += found.scores[i];
    }
  }
  return sums;
}

/// The rows of a scene in one engine. "Always contact" is left out: no threshold changes its
/// decisions.
void add_rows(const Evaluation& evaluation, std::size_t scene, const OperatingRow& of_scene,
              std::vector<OperatingRow>& rows) {
  const RunGroup& group = evaluation.plan.groups.front();
  const std::vector<scoring::Hysteresis> points =
      points_of(evaluation.request.experiment.studies.at<OperatingPointsConfig>());
  const std::vector<Condition> conditions = tested_on(group.conditions, of_scene.simulator);
  for (const auto& [place, scores] : scores_of(evaluation, scene, of_scene.simulator)) {
    OperatingRow row = of_scene;
    row.estimator = conditions[place.first].estimator;
    row.noise = group.scored[place.second];
    if (row.estimator == always_contact_name) continue;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      if (i > 0) row.thresholds = points[i - 1];
      row.score = scores[i];
      rows.push_back(row);
    }
  }
}

/// The mean of defined values; NaN without any.
class MeanOfDefined {
 public:
  void add(double value) {
    if (std::isnan(value)) return;
    sum_ += value;
    count_ += 1.0;
  }
  double value() const {
    return count_ > 0.0 ? sum_ / count_ : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  double sum_ = 0.0;
  double count_ = 0.0;
};

/// The mean over the rows of one estimator in one noise setting.
OperatingMean mean_of(const std::vector<OperatingRow>& rows) {
  MeanOfDefined balanced_accuracy;
  MeanOfDefined extra_switches;
  MeanOfDefined false_takeoffs;
  MeanOfDefined takeoff_error;
  scoring::OperatingScore all;
  for (const OperatingRow& row : rows) {
    balanced_accuracy.add(row.score.points.balanced_accuracy());
    extra_switches.add(row.score.extra_switches_per_minute());
    false_takeoffs.add(row.score.false_takeoffs_per_minute());
    takeoff_error.add(row.score.takeoff_error());
    all += row.score;
  }
  return {rows.front().noise,        rows.front().estimator,         rows.front().thresholds,
          balanced_accuracy.value(), extra_switches.value(),         false_takeoffs.value(),
          takeoff_error.value(),     all.extra_switches_per_flight()};
}

/// Marks the points of one estimator in one noise setting that no other point dominates.
void mark_front(const std::vector<OperatingMean*>& means) {
  const auto dominates = [](const OperatingMean& one, const OperatingMean& other) {
    const bool is_no_worse = one.balanced_accuracy >= other.balanced_accuracy &&
                             one.extra_switches_per_minute <= other.extra_switches_per_minute;
    return is_no_worse && (one.balanced_accuracy > other.balanced_accuracy ||
                           one.extra_switches_per_minute < other.extra_switches_per_minute);
  };
  for (OperatingMean* mean : means) {
    mean->is_on_front = std::none_of(means.begin(), means.end(), [&](const OperatingMean* other) {
      return dominates(*other, *mean);
    });
  }
}

bool are_of_one(const auto& one, const auto& other) {
  return one.estimator == other.estimator && one.noise == other.noise;
}

}  // namespace

std::vector<OperatingRow> operating_rows(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  std::vector<OperatingRow> rows;
  for (std::size_t scene = 0; scene < experiment.test.scenarios.size(); ++scene) {
    const std::string& file = experiment.test.scenarios[scene];
    for (const std::string& simulator : experiment.simulators) {
      const std::string& name = scenario_of(evaluation.request, file).scenario.name;
      add_rows(evaluation, scene, {simulator, name, {}, {}}, rows);
    }
  }
  return rows;
}

std::vector<OperatingMean> operating_means(const std::vector<OperatingRow>& rows) {
  const auto point_of = [](const OperatingRow& row) {
    return std::tuple(row.estimator, row.noise, row.thresholds);
  };
  std::vector<OperatingMean> means;
  for (const auto& alike : group_by(rows, point_of)) means.push_back(mean_of(alike.rows));
  std::stable_sort(means.begin(), means.end(), [](const auto& one, const auto& other) {
    return std::pair(one.noise.torque, one.noise.accelerometer) <
           std::pair(other.noise.torque, other.noise.accelerometer);
  });
  for (const OperatingMean& own : means) {
    if (own.thresholds) continue;
    std::vector<OperatingMean*> others;
    for (OperatingMean& mean : means) {
      if (mean.thresholds && are_of_one(mean, own)) others.push_back(&mean);
    }
    mark_front(others);
  }
  return means;
}

}  // namespace touchdown::experiments
