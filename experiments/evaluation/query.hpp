#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "core/columns.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "scoring/bootstrap.hpp"
#include "scoring/classification.hpp"

namespace touchdown::experiments {

/// A score that adds up, with all that it can be grouped by. The noise seeds of a run are added. A
/// row without a run says that its group has no scored run. The plan must outlive it.
template <typename Score>
struct Scored {
  const PlannedRun* run = nullptr;  ///< engine, scene, robot, sensors, draw
  std::size_t segment = 0;          ///< of the run: a drop
  const Condition* condition = nullptr;
  const noise::NoiseCell* noise = nullptr;
  std::size_t item = 0;  ///< place in a list that the score belongs to: a view, a bin
  Score score = {};
};

/// A part of countable events, for metrics that are shares. It adds over runs.
struct Share {
  std::int64_t part = 0;
  std::int64_t whole = 0;

  Share& operator+=(const Share& other) {
    part += other.part;
    whole += other.whole;
    return *this;
  }
  /// NaN without events.
  double value() const { return scoring::ratio(part, whole); }
};

/// The rows of some conditions, by condition, noise setting, then run. `cells` are those of the
/// scores.
template <typename Score>
std::vector<Scored<Score>> rows_of(const std::vector<ConditionSamples<Score>>& all,
                                   const std::vector<noise::NoiseCell>& cells,
                                   const CollectedCounts& collected, const Plan& plan) {
  std::vector<Scored<Score>> rows;
  for (const ConditionSamples<Score>& one : all) {
    const auto origins = collected.origins.find(one.condition.test_simulator);
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      Scored<Score> row{.condition = &one.condition, .noise = &cells[cell]};
      if (one.samples[cell].empty()) rows.push_back(row);
      for (std::size_t i = 0; i < one.samples[cell].size(); ++i) {
        const SampleOrigin& origin = origins->second[i];
        row.run = &plan.runs[origin.run];
        row.segment = origin.segment;
        row.score = one.samples[cell][i];
        rows.push_back(row);
      }
    }
  }
  return rows;
}

/// The rows of a measure of predictions in these runs of one group, by condition, noise setting,
/// run, then item. Conditions without scores have no rows. Errors: `Error` when a task is missing.
template <typename Score>
std::vector<Scored<Score>> rows_of(std::string_view measure, std::span<const std::size_t> runs,
                                   const Plan& plan, const Store& store) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Scored<Score>>> by_setting;
  for (const std::size_t index : runs) {
    const PlannedRun& run = plan.runs[index];
    const RunGroup& group = plan.groups[run.group];
    std::vector<std::size_t> tested;  // of the group's conditions
    for (std::size_t c = 0; c < group.conditions.size(); ++c) {
      if (group.conditions[c].test_simulator == run.simulator) tested.push_back(c);
    }
    for (const MeasuredScores<Score>& found : measured<Score>(measure, index, plan, store)) {
      if (found.condition == no_condition) continue;
      const std::size_t condition = tested[found.condition];
      for (std::size_t item = 0; item < found.scores.size(); ++item) {
        by_setting[{condition, found.cell}].push_back({&run, 0, &group.conditions[condition],
                                                       &group.scored[found.cell], item,
                                                       found.scores[item]});
      }
    }
  }
  std::vector<Scored<Score>> rows;
  for (const auto& [setting, of_setting] : by_setting) {
    rows.insert(rows.end(), of_setting.begin(), of_setting.end());
  }
  return rows;
}

/// A number of a sum of scores.
template <typename Score>
struct Statistic {
  std::string name;
  std::function<double(const Score&)> of;
  /// The number of events of a share of events, for `scoring::with_exact_end`.
  std::function<std::int64_t(const Score&)> events = {};
};

/// A question to scored rows: a line for each different combination of keys.
template <typename Score>
struct Query {
  Columns<Scored<Score>> by;                 ///< keys
  std::vector<Statistic<Score>> statistics;  ///< each with its interval over runs, or drops
  Columns<Score> totals = {};                ///< of the sum of a line's scores
  std::string runs = {};                     ///< name of a column with their number; empty: none
};

template <typename Score>
struct Answer {
  Table table;
  std::vector<Score> totals = {};  ///< by row
};

/// Lines are in the order of their first rows. Rows of one run and segment are one sample.
template <typename Score>
Answer<Score> answer(const std::vector<Scored<Score>>& rows, const Query<Score>& query,
                     const scoring::BootstrapConfig& bootstrap) {
  const Table keys = query.by.table(rows);
  std::map<std::vector<std::string>, std::size_t> known;
  std::vector<std::vector<const Scored<Score>*>> lines;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto [place, is_new] = known.emplace(TableRow(keys, i).texts(), lines.size());
    if (is_new) lines.emplace_back();
    lines[place->second].push_back(&rows[i]);
  }
  std::vector<std::function<double(const Score&)>> statistics;
  Table table{query.by.list(), std::vector<std::vector<Cell>>(lines.size())};
  for (const Statistic<Score>& one : query.statistics) {
    statistics.push_back(one.of);
    table.columns.push_back({one.name, ColumnRole::metric, ColumnType::measured});
    table.columns.push_back({bound_name(one.name, "_low"), ColumnRole::low, ColumnType::measured});
    table.columns.push_back(
        {bound_name(one.name, "_high"), ColumnRole::high, ColumnType::measured});
  }
  table.columns.insert(table.columns.end(), query.totals.list().begin(), query.totals.list().end());
  if (!query.runs.empty()) {
    table.columns.push_back({query.runs, ColumnRole::runs, ColumnType::count});
  }
  std::vector<Score> totals(lines.size());
  tbb::parallel_for(std::size_t{0}, lines.size(), [&](std::size_t line) {
    std::vector<Score> samples;
    const Scored<Score>* last = nullptr;
    for (const Scored<Score>* row : lines[line]) {
      if (row->run == nullptr) continue;
      const bool is_new = last == nullptr || last->run != row->run || last->segment != row->segment;
      if (is_new) samples.emplace_back();
      samples.back() += row->score;
      last = row;
    }
    totals[line] = scoring::sum(samples);
    std::vector<Cell>& cells = table.rows[line];
    query.by.add_cells(*lines[line].front(), cells);
    const std::vector<Interval> intervals =
        scoring::bootstrap<Score>(samples, statistics, bootstrap);
    for (std::size_t s = 0; s < statistics.size(); ++s) {
      const auto& events = query.statistics[s].events;
      const Interval interval =
          events ? scoring::with_exact_end(intervals[s], events(totals[line]), bootstrap.level)
                 : intervals[s];
      for (const double value : {interval.estimate, interval.low, interval.high}) {
        cells.emplace_back(rounded(value));
      }
    }
    query.totals.add_cells(totals[line], cells);
    if (!query.runs.empty()) cells.emplace_back(static_cast<std::int64_t>(samples.size()));
  });
  return {std::move(table), std::move(totals)};
}

/// The keys of most tables: engine, estimator, noise setting.
template <typename Score>
Columns<Scored<Score>> setting_keys() {
  using Row = Scored<Score>;
  return Columns<Row>()
      .text("simulator", [](const Row& row) { return row.condition->test_simulator; })
      .text("estimator", [](const Row& row) { return row.condition->estimator; })
      .part([](const Row& row) -> const noise::NoiseCell& { return *row.noise; }, noise_columns());
}

}  // namespace touchdown::experiments
