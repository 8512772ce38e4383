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
#include "experiments/evaluation/scored.hpp"
#include "scoring/bootstrap.hpp"
#include "scoring/classification.hpp"

namespace touchdown::experiments {

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

/// A number of a sum of scores.
template <typename Score>
struct Statistic {
  std::string name;
  std::function<double(const Score&)> of;
  /// The number of events of a share of events, for `scoring::with_exact_end`.
  std::function<std::int64_t(const Score&)> events = {};
};

/// A statistic of a line minus that of other rows, on the same runs.
template <typename Score>
struct Difference {
  std::string name;
  std::function<double(const Score&)> of;
  /// Whether the second row is of those other rows, for a row of the line.
  std::function<bool(const Scored<Score>& line, const Scored<Score>& other)> from;
  bool is_reversed = false;  ///< that of the other rows minus the line's
};

/// A question to scored rows: a line for each different combination of keys.
template <typename Score>
struct Query {
  Columns<Scored<Score>> by;                        ///< keys
  std::vector<Statistic<Score>> statistics;         ///< each with its interval over runs, or drops
  std::vector<Difference<Score>> differences = {};  ///< likewise, paired
  Columns<Score> totals = {};                       ///< of the sum of a line's scores
  std::string runs = {};  ///< name of a column with their number; empty: none
};

/// The sum of rows of one run and segment is one sample. Rows without a run are none.
template <typename Score>
std::vector<Score> samples_of(const std::vector<const Scored<Score>*>& rows) {
  std::vector<Score> samples;
  const Scored<Score>* last = nullptr;
  for (const Scored<Score>* row : rows) {
    if (row->run == nullptr) continue;
    const bool is_new = last == nullptr || last->run != row->run || last->segment != row->segment;
    if (is_new) samples.emplace_back();
    samples.back() += row->score;
    last = row;
  }
  return samples;
}

template <typename Score>
struct Answer {
  Table table;
  std::vector<Score> totals = {};  ///< by row
};

/// Lines are in the order of their first rows.
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
    add_interval(one.name, table.columns);
  }
  for (const Difference<Score>& one : query.differences) add_interval(one.name, table.columns);
  table.columns.insert(table.columns.end(), query.totals.list().begin(), query.totals.list().end());
  if (!query.runs.empty()) {
    table.columns.push_back({query.runs, ColumnRole::runs, ColumnType::count});
  }
  std::vector<Score> totals(lines.size());
  tbb::parallel_for(std::size_t{0}, lines.size(), [&](std::size_t line) {
    const std::vector<Score> samples = samples_of(lines[line]);
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
      add_interval(interval, cells);
    }
    for (const Difference<Score>& one : query.differences) {
      std::vector<const Scored<Score>*> others;
      for (const Scored<Score>& row : rows) {
        if (one.from(*lines[line].front(), row)) others.push_back(&row);
      }
      std::vector<Score> first = samples, second = samples_of(others);
      if (one.is_reversed) first.swap(second);
      add_interval(scoring::bootstrap_differences<Score>(first, second, {one.of}, bootstrap)[0],
                   cells);
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
