#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "logs/sample_times.hpp"

namespace touchdown::logs {

/// Ages of held values: how much older they are than the rows that they are added to.
class Ages {
 public:
  void add(double age) { ages_.push_back(static_cast<float>(age)); }

  std::size_t count() const { return ages_.size(); }
  /// s; 0 without values.
  double largest() const {
    return ages_.empty() ? 0.0 : static_cast<double>(*std::max_element(ages_.begin(), ages_.end()));
  }
  double median() const { return ages_.empty() ? 0.0 : logs::median({ages_.begin(), ages_.end()}); }

 private:
  std::vector<float> ages_;
};

/// All rows of a source with a clock of its own, in any order.
struct SourceRows {
  struct Row {
    double time = 0.0;           ///< by the source's clock (s)
    double arrival = 0.0;        ///< s, by one clock for all sources; 0 where there is none
    std::uint64_t position = 0;  ///< among the rows of the log, for messages
    std::size_t first = 0;       ///< its first number in `values`
    std::size_t recording = 0;   ///< how often the source's clock started again before it
  };
  // Blocks: a vector that grows would need its memory twice.
  std::deque<Row> rows;
  std::deque<double> values;
  std::uint64_t without_time = 0;
  std::uint64_t first_without_time = 0;  ///< its position

  /// A row without a finite time is left out, and counted.
  void add(double arrival, double time, std::span<const double> row, std::uint64_t position);
};

/// What a source's clock did from row to row, in the order of arrival.
struct ClockSteps {
  std::vector<std::uint64_t> restarts;  ///< positions of the first rows behind them
  std::uint64_t left_out = 0;           ///< rows with wrong times
  SourceRows::Row first_left_out;
  std::uint64_t steps_back = 0;
  SourceRows::Row first_back;
  bool is_scrambled = false;  ///< more steps back than restarts and wrong times explain
};

/// Numbers the recordings of a source: a large step back of the clock starts another one, as of a
/// simulation that starts again. If the clock goes on as before without the `longest_error` rows at
/// the step, their times are wrong, and they are left out.
ClockSteps split_recordings(std::deque<SourceRows::Row>& rows);

/// Joins sources with clocks and rates of their own: each row of one source, the joints', gets the
/// latest values of the others that were measured not later. Values older than `stale_after` are
/// missing (NaN). Rows of one time belong together if they arrive within `arrival_window` of each
/// other; without times of arrival, if they are of the same recording.
class SourceJoin {
 public:
  static constexpr double arrival_window = 0.5;  // s
  /// Rows that arrive in another order than they were measured are sorted, if they are late by at
  /// most this (s). A larger step back is one of the clock.
  static constexpr double largest_disorder = 0.1;
  static constexpr std::size_t longest_error = 3;  // rows

  struct Config {
    /// Where the numbers of each source's rows are in a joined row.
    std::vector<std::vector<std::size_t>> columns;
    std::size_t clock = 0;      ///< the source that gives the rows
    bool has_arrival = true;    ///< rows have times of arrival
    double stale_after = 0.05;  ///< s
  };

  /// What became of one source's rows.
  struct Report {
    double first = 0.0;       ///< time of the first row (s)
    double last = 0.0;        ///< time of the last row (s)
    Ages ages;                ///< of values in joined rows
    std::uint64_t stale = 0;  ///< joined rows without a value of this source
    ClockSteps steps;         ///< of the joints, and of all sources without times of arrival
  };

  SourceJoin(std::vector<SourceRows> sources, Config config);

  /// Writes the next joined row. Returns false at the end.
  bool next(std::vector<double>& row);
  /// That of the joints' row that was joined last.
  std::uint64_t position() const { return position_; }

  const Report& report(std::size_t source) const { return sources_[source].report; }
  /// Rows of this source that had no time, and the position of the first one.
  const SourceRows& source(std::size_t source) const { return sources_[source].all; }
  std::uint64_t rows() const { return rows_; }
  /// Rows of the joints before every other source had a value; they are left out.
  std::uint64_t rows_before() const { return rows_before_; }

 private:
  struct Source {
    SourceRows all;
    bool has_begun = false;
    Report report;
  };

  bool are_together(const SourceRows::Row& one, const SourceRows::Row& other) const;
  const SourceRows::Row* latest(const SourceRows& source, const SourceRows::Row& joints) const;
  bool hold(std::size_t source, const SourceRows::Row& joints, std::vector<double>& row);

  Config config_;
  std::size_t width_ = 0;
  std::vector<Source> sources_;
  std::size_t next_ = 0;  ///< row of the joints
  std::uint64_t position_ = 0;
  std::uint64_t rows_ = 0;
  std::uint64_t rows_before_ = 0;
};

}  // namespace touchdown::logs
