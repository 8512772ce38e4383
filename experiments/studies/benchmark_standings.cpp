#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

#include "core/rows.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/studies/benchmark.hpp"

namespace touchdown::experiments {

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

bool is_upper_bound_entry(const Standings::Entry& entry) { return is_upper_bound(entry.estimator); }

double bits_of(const BenchmarkRow& row) {
  return row.extended.log_loss / static_cast<double>(row.extended.steps) / std::numbers::ln2;
}

std::vector<Standings::Entry> entries_of(const Rows& rows, const std::vector<Named>& means,
                                         double level) {
  std::vector<Standings::Entry> entries;
  for (const Named& mean : means) {
    Standings::Entry entry;
    entry.estimator = mean.name;
    entry.mean = interval_of(mean.value, level);
    entry.worst = 1.0;
    for (const BenchmarkRow* row : rows) {
      if (row->estimator == mean.name) {
        entry.log_loss += bits_of(*row);
        entry.extra_switches += extra_switches_per_minute(*row);
        ++entry.scored;
      }
      const double value = row->balanced_accuracy.estimate;
      if (row->estimator != mean.name || value > entry.worst) continue;
      entry.worst = value;
      entry.worst_scene = row->scene;
      entry.worst_simulator = row->simulator;
    }
    entry.log_loss /= static_cast<double>(entry.scored);
    entry.extra_switches /= static_cast<double>(entry.scored);
    entries.push_back(std::move(entry));
  }
  double least = std::numeric_limits<double>::quiet_NaN();  // of the upper bounds
  for (const Standings::Entry& entry : entries) {
    if (is_upper_bound_entry(entry)) least = std::fmin(least, entry.log_loss);
  }
  for (Standings::Entry& entry : entries) entry.excess_log_loss = entry.log_loss - least;
  std::stable_sort(entries.begin(), entries.end(), [](const auto& one, const auto& other) {
    return one.mean.estimate > other.mean.estimate;
  });
  return entries;
}

void mark_not_significantly_worse(std::vector<Standings::Entry>& entries,
                                  const std::vector<Standings::Difference>& means) {
  const auto first = std::find_if_not(entries.begin(), entries.end(), is_upper_bound_entry);
  if (first == entries.end()) return;
  const std::string& best = first->estimator;
  for (Standings::Entry& entry : entries) {
    entry.is_not_significantly_worse =
        entry.estimator == best || std::any_of(means.begin(), means.end(), [&](const auto& pair) {
          const bool is_theirs = (pair.first == best && pair.second == entry.estimator) ||
                                 (pair.second == best && pair.first == entry.estimator);
          return is_theirs && pair.value.low <= 0.0 && pair.value.high >= 0.0;
        });
  }
}

/// Standings of in-domain rows; `with_scenes` adds the differences in every scene.
std::vector<Standings> standings_of(const Rows& planned, bool with_scenes,
                                    const scoring::BootstrapConfig& intervals) {
  const double level = intervals.level;
  Rows own = planned;
  std::erase_if(own, [](const BenchmarkRow* row) { return !row->is_scored(); });
  std::vector<Standings> all;
  for (const auto& scored : group_by(own, setting_of)) {
    const Rows alike = complete_ones(scored.rows);
    const std::vector<Named> means = means_by_estimator(alike, intervals);
    Standings standings{alike.front()->robot, alike.front()->sensors, alike.front()->noise,
                        entries_of(alike, means, level), all_pairs("", means, level)};
    for (Standings::Entry& entry : standings.entries) {
      entry.planned = where(planned, [&](const BenchmarkRow* row) {
                        return row->estimator == entry.estimator &&
                               setting_of(row) == setting_of(alike.front());
                      }).size();
    }
    mark_not_significantly_worse(standings.entries, standings.differences);
    for (const auto& scene : group_by(with_scenes ? alike : Rows(), scene_name)) {
      const auto pairs = all_pairs(scene.key, means_by_estimator(scene.rows, intervals), level);
      standings.differences.insert(standings.differences.end(), pairs.begin(), pairs.end());
    }
    all.push_back(std::move(standings));
  }
  return all;
}

Rows in_domain(const std::vector<BenchmarkRow>& rows) {
  Rows own;
  for (const BenchmarkRow& row : rows) {
    if (row.fitted_on == "own") own.push_back(&row);
  }
  return own;
}

}  // namespace

std::vector<Standings> standings(const std::vector<BenchmarkRow>& rows,
                                 const scoring::BootstrapConfig& intervals) {
  return standings_of(in_domain(rows), true, intervals);
}

std::vector<Standings> standings_of_unseen(const std::vector<BenchmarkRow>& rows,
                                           const scoring::BootstrapConfig& intervals) {
  Rows unseen = in_domain(rows);
  std::erase_if(unseen, [](const BenchmarkRow* row) { return row->split != "unseen"; });
  return standings_of(unseen, false, intervals);
}

}  // namespace touchdown::experiments
