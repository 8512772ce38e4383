#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/rows.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/evaluation/joint_bootstrap.hpp"
#include "experiments/studies/benchmark.hpp"

namespace touchdown::experiments {

namespace {

bool is_fitted_scene(const Experiment& experiment, const std::string& file) {
  const std::vector<std::string>& fitted = experiment.fit.scenarios;
  return std::find(fitted.begin(), fitted.end(), file) != fitted.end();
}

std::string fitted_on(const Condition& condition, const BenchmarkSetup& here,
                      const std::vector<BenchmarkSetup>& setups) {
  if (condition.is_fitted_in_domain(here.runs.fit)) return "own";
  if (condition.fit_simulator != condition.test_simulator) return condition.fit_simulator;
  const auto there = std::find_if(setups.begin(), setups.end(), [&](const BenchmarkSetup& setup) {
    return setup.runs.fit == condition.fit;
  });
  return fmt::format("{} {}", there->robot, there->sensors);
}

/// The time of true air (s).
double air_of(const scoring::Score& score) {
  const double share = scoring::ratio(score.points.flight(), score.points.points());
  return 1e-6 * static_cast<double>(score.scored_us) * share;
}

/// The scores of some conditions in the runs of one setup.
struct SetupScores {
  const BenchmarkSetup* setup;
  std::vector<Condition> conditions;
  std::vector<Scored<scoring::RobotScore>> scored = {};
  std::vector<Scored<scoring::ExtendedScore>> extended = {};
};

/// Scene, highlighted noise setting, and the condition without its refit.
using RowKey =
    std::tuple<std::size_t, std::size_t, std::string, std::string, std::string, std::string>;
RowKey key_of(std::size_t scene, std::size_t cell, const Condition& condition) {
  return {
      scene,        cell, condition.test_simulator, condition.estimator, condition.fit_simulator,
      condition.fit};
}

/// The rows of scored runs.
template <typename Score>
auto by_key(const std::vector<Scored<Score>>& rows, const Experiment& experiment) {
  std::map<RowKey, std::vector<const Scored<Score>*>> found;
  for (const Scored<Score>& row : rows) {
    if (row.run == nullptr) continue;
    found[key_of(scene_of(*row.run, experiment),
                 noise::cell_index(experiment.highlights, *row.noise), *row.condition)]
        .push_back(&row);
  }
  return found;
}

/// By scene, condition, then noise.
void add_rows(const SetupScores& scores, const Evaluation& evaluation,
              const std::vector<BenchmarkSetup>& setups, std::vector<BenchmarkRow>& rows) {
  const Experiment& experiment = evaluation.request.experiment;
  const std::vector<std::string>& scenes = experiment.test.scenarios;
  const auto scored = by_key(scores.scored, experiment);
  const auto extended = by_key(scores.extended, experiment);
  for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
    for (const Condition& condition : scores.conditions) {
      if (condition.refit > 0) continue;
      BenchmarkRow row{.simulator = condition.test_simulator,
                       .robot = scores.setup->robot,
                       .sensors = scores.setup->sensors,
                       .scene = scenario_of(evaluation.request, scenes[scene]).scenario.name,
                       .split = is_fitted_scene(experiment, scenes[scene]) ? "test" : "unseen",
                       .estimator = condition.estimator,
                       .fitted_on = fitted_on(condition, *scores.setup, setups)};
      for (const std::size_t run :
           evaluation.plan.runs_in(scores.setup->group, condition.test_simulator)) {
        const FinishedRun& finished = evaluation.runs.at(run);
        row.failed += scene_of(finished.plan, experiment) == scene && finished.failed() ? 1 : 0;
      }
      for (std::size_t cell = 0; cell < experiment.highlights.size(); ++cell) {
        const auto found = scored.find(key_of(scene, cell, condition));
        BenchmarkRow of_cell = row;
        of_cell.noise = experiment.highlights[cell];
        of_cell.balanced_accuracy = {std::numeric_limits<double>::quiet_NaN()};
        of_cell.runs = row.failed;
        if (found != scored.end()) {
          std::set<const PlannedRun*> runs;
          for (const auto* one : found->second) {
            runs.insert(one->run);
            of_cell.refits =
                std::max(of_cell.refits, static_cast<std::size_t>(one->condition->refit));
            if (one->condition->refit == 0) of_cell.score += one->score.wheels();
          }
          of_cell.runs += static_cast<int>(runs.size());
          of_cell.balanced_accuracy =
              balanced_accuracies(found->second, experiment).front().front();
          for (const auto* one : extended.at(found->first)) of_cell.extended += one->score;
          of_cell.air = air_of(of_cell.score) / static_cast<double>(experiment.noise.seeds);
        }
        if (of_cell.runs > 0) rows.push_back(std::move(of_cell));
      }
    }
  }
}

constexpr const char* submission_parts = "submissions";

/// The scores of a submission in the runs of one setup, as those of an estimator fitted there.
SetupScores submitted(const std::string& name, const std::vector<SubmittedRun>& runs,
                      const BenchmarkSetup& setup, const Evaluation& evaluation) {
  const Plan& plan = evaluation.plan;
  const Experiment& experiment = evaluation.request.experiment;
  SetupScores scores{.setup = &setup, .conditions = {}};
  for (const std::string& simulator : experiment.simulators) {
    scores.conditions.push_back({simulator, simulator, name, setup.runs.fit});
  }
  RowsBySetting<scoring::RobotScore> scored;
  RowsBySetting<scoring::ExtendedScore> extended;
  for (const SubmittedRun& one : runs) {
    const PlannedRun& run = plan.runs[plan.tasks[one.task].run];
    if (run.group != setup.group) continue;
    const Condition& condition =
        *std::ranges::find(scores.conditions, run.simulator, &Condition::test_simulator);
    const noise::NoiseCell* const noise = &experiment.highlights[one.cell];
    for (std::size_t segment = 0; segment < one.score.size(); ++segment) {
      scored.add(0, one.cell, {&run, segment, &condition, noise, 0, one.score[segment]});
    }
    extended.add(0, one.cell, {&run, 0, &condition, noise, 0, one.extended});
  }
  scores.scored = scored.take();
  scores.extended = extended.take();
  return scores;
}

}  // namespace

void save(const std::string& name, const std::vector<SubmittedRun>& runs, const Store& store) {
  store.put(submission_parts, name, runs);
}

std::vector<BenchmarkRow> benchmark_rows(const Evaluation& evaluation,
                                         const RunDirectory& directory) {
  const Plan& plan = evaluation.plan;
  const std::vector<BenchmarkSetup> setups = benchmark_setups(evaluation.request, plan);
  std::vector<BenchmarkRow> rows;
  for (const BenchmarkSetup& setup : setups) {
    const RunGroup& group = plan.groups[setup.group];
    const std::vector<std::size_t> runs = plan.runs_in(setup.group);
    const SetupScores scores{
        .setup = &setup,
        .conditions = where(group.conditions, [&](const auto& one) { return group.predicts(one); }),
        .scored = score_rows(runs, plan, evaluation.saved).scored,
        .extended =
            rows_of<scoring::ExtendedScore>(extended_measure, runs, plan, evaluation.saved)};
    add_rows(scores, evaluation, setups, rows);
  }
  for (const std::string& name : directory.store().names(submission_parts)) {
    const auto runs = directory.store().find<std::vector<SubmittedRun>>(submission_parts, name);
    for (const BenchmarkSetup& setup : setups) {
      if (runs) add_rows(submitted(name, *runs, setup, evaluation), evaluation, setups, rows);
    }
  }
  return rows;
}

namespace {

using Rows = std::vector<const BenchmarkRow*>;

std::string estimator_of(const BenchmarkRow* row) { return row->estimator; }

std::string scene_name(const BenchmarkRow* row) { return row->scene; }

auto setting_of(const BenchmarkRow* row) {
  return std::tuple(row->robot, row->sensors, row->noise);
}

/// The mean over the rows' scenes and engines.
Resampled mean_of(const Rows& rows, const scoring::BootstrapConfig& bootstrap) {
  std::vector<SceneValues> scenes;
  for (const auto& scene : group_by(rows, scene_name)) {
    SceneValues& values = scenes.emplace_back();
    for (const BenchmarkRow* row : scene.rows) values.push_back(row->balanced_accuracy);
  }
  return mean_over_scenes(scenes, bootstrap);
}

struct Named {
  std::string name;
  Resampled value;
};

std::vector<Named> means_by_estimator(const Rows& rows, const scoring::BootstrapConfig& bootstrap) {
  std::vector<Named> means;
  for (const auto& own : group_by(rows, estimator_of)) {
    means.push_back({own.key, mean_of(own.rows, bootstrap)});
  }
  return means;
}

double standard_error(const Resampled& resampled) {
  const auto count = static_cast<double>(resampled.values.size());
  double squares = 0.0;
  for (const double value : resampled.values) {
    squares += (value - resampled.estimate) * (value - resampled.estimate);
  }
  return std::sqrt(squares / count);
}

/// Simultaneous bands, which all hold with probability `level`.
std::vector<Interval> simultaneous(const std::vector<Resampled>& all, double level) {
  std::vector<double> errors;
  std::vector<double> largest;
  for (const Resampled& one : all) {
    errors.push_back(standard_error(one));
    largest.resize(one.values.size());
    for (std::size_t r = 0; r < one.values.size() && errors.back() > 0.0; ++r) {
      largest[r] = std::fmax(largest[r], std::abs(one.values[r] - one.estimate) / errors.back());
    }
  }
  double reach = std::numeric_limits<double>::quiet_NaN();
  if (!largest.empty()) {
    const auto last = static_cast<double>(largest.size() - 1);
    const auto place = largest.begin() + static_cast<std::ptrdiff_t>(std::ceil(level * last));
    std::nth_element(largest.begin(), place, largest.end());
    reach = *place;
  }
  std::vector<Interval> bands;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double half = reach * errors[i];
    bands.push_back({all[i].estimate, all[i].estimate - half, all[i].estimate + half});
  }
  return bands;
}

/// Leaves out estimators that were not scored in every scored run: comparisons need the same runs.
Rows complete_ones(const Rows& rows) {
  std::map<std::string, int> runs;
  int most = 0;
  for (const BenchmarkRow* row : rows) {
    most = std::max(most, runs[row->estimator] += row->runs - row->failed);
  }
  Rows complete = rows;
  std::erase_if(complete, [&](const BenchmarkRow* row) { return runs.at(row->estimator) < most; });
  return complete;
}

std::vector<Standings::Difference> all_pairs(const std::string& scene,
                                             const std::vector<Named>& estimators, double level) {
  std::vector<Standings::Difference> pairs;
  std::vector<Resampled> values;
  for (std::size_t i = 0; i < estimators.size(); ++i) {
    for (std::size_t j = i + 1; j < estimators.size(); ++j) {
      pairs.push_back({scene, estimators[i].name, estimators[j].name, {}});
      values.push_back(estimators[i].value - estimators[j].value);
    }
  }
  const std::vector<Interval> bands = simultaneous(values, level);
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].value = bands[i];
  return pairs;
}

double bits_of(const BenchmarkRow& row) {
  return row.extended.log_loss / static_cast<double>(row.extended.steps) / std::numbers::ln2;
}

bool has_air(const BenchmarkRow* row) { return row->air >= least_air; }

/// Rows whose balanced accuracy counts.
Rows with_air(const Rows& rows) {
  return std::ranges::any_of(rows, has_air) ? where(rows, has_air) : rows;
}

/// F1 of the events in all scenes and engines. Scenes without events say nothing about its
/// interval.
Interval event_f1(const Rows& rows, const scoring::BootstrapConfig& bootstrap) {
  std::vector<scoring::EventScore> scenes;
  for (const auto& scene : group_by(rows, scene_name)) {
    scoring::EventScore& sum = scenes.emplace_back();
    for (const BenchmarkRow* row : scene.rows) sum += row->score.events;
  }
  std::erase_if(scenes, [](const auto& sum) { return sum.truth + sum.decided == 0; });
  if (scenes.empty()) return {NAN, NAN, NAN};
  return scoring::bootstrap<scoring::EventScore>(scenes, {&scoring::EventScore::f1}, bootstrap)
      .front();
}

std::vector<Standings::Entry> entries_of(const Rows& rows, const std::vector<Named>& means,
                                         const scoring::BootstrapConfig& bootstrap) {
  std::vector<Standings::Entry> entries;
  for (const Named& mean : means) {
    const Rows own =
        where(rows, [&](const BenchmarkRow* row) { return row->estimator == mean.name; });
    const Rows judged = with_air(own);
    Standings::Entry entry;
    entry.estimator = mean.name;
    entry.event_f1 = event_f1(own, bootstrap);
    entry.mean = interval_of(mean.value, bootstrap.level);
    entry.worst = 1.0;
    entry.scored = own.size();
    entry.without_air = static_cast<std::size_t>(std::ranges::count_if(own, std::not_fn(has_air)));
    for (const BenchmarkRow* row : own) {
      entry.score += row->score;
      entry.log_loss += bits_of(*row);
    }
    for (const BenchmarkRow* row : judged) {
      const double value = row->balanced_accuracy.estimate;
      if (value > entry.worst) continue;
      entry.worst = value;
      entry.worst_scene = row->scene;
      entry.worst_simulator = row->simulator;
    }
    entry.log_loss /= static_cast<double>(entry.scored);
    entries.push_back(std::move(entry));
  }
  std::stable_sort(entries.begin(), entries.end(), [](const auto& one, const auto& other) {
    const auto rank = [](const Standings::Entry& entry) {
      const double f1 = entry.event_f1.estimate;  // NaN where nothing takes off
      return std::pair(std::isnan(f1) ? 0.0 : f1, entry.mean.estimate);
    };
    return rank(one) > rank(other);
  });
  return entries;
}

void mark_not_significantly_worse(std::vector<Standings::Entry>& entries,
                                  const std::vector<Standings::Difference>& means) {
  if (entries.empty()) return;
  const std::string best = std::ranges::max_element(entries, {}, [](const Standings::Entry& entry) {
                             return entry.mean.estimate;
                           })->estimator;
  for (Standings::Entry& entry : entries) {
    entry.is_not_significantly_worse =
        entry.estimator == best || std::any_of(means.begin(), means.end(), [&](const auto& pair) {
          const bool is_theirs = (pair.first == best && pair.second == entry.estimator) ||
                                 (pair.second == best && pair.first == entry.estimator);
          return is_theirs && pair.value.low <= 0.0 && pair.value.high >= 0.0;
        });
  }
}

}  // namespace

std::vector<Standings> standings(const std::vector<BenchmarkRow>& rows,
                                 const scoring::BootstrapConfig& intervals, bool only_unseen) {
  Rows planned;
  for (const BenchmarkRow& row : rows) {
    const bool is_wanted = !only_unseen || row.split == "unseen";
    if (row.fitted_on == "own" && is_wanted) planned.push_back(&row);
  }
  const double level = intervals.level;
  Rows own = planned;
  std::erase_if(own, [](const BenchmarkRow* row) { return !row->is_scored(); });
  std::vector<Standings> all;
  for (const auto& scored : group_by(own, setting_of)) {
    const Rows alike = complete_ones(scored.rows);
    const std::vector<Named> means = means_by_estimator(with_air(alike), intervals);
    Standings standings{alike.front()->robot, alike.front()->sensors, alike.front()->noise,
                        entries_of(alike, means, intervals), all_pairs("", means, level)};
    for (Standings::Entry& entry : standings.entries) {
      entry.planned = where(planned, [&](const BenchmarkRow* row) {
                        return row->estimator == entry.estimator &&
                               setting_of(row) == setting_of(alike.front());
                      }).size();
    }
    mark_not_significantly_worse(standings.entries, standings.differences);
    for (const auto& scene : group_by(only_unseen ? Rows() : alike, scene_name)) {
      const auto pairs = all_pairs(scene.key, means_by_estimator(scene.rows, intervals), level);
      standings.differences.insert(standings.differences.end(), pairs.begin(), pairs.end());
    }
    all.push_back(std::move(standings));
  }
  return all;
}

}  // namespace touchdown::experiments
