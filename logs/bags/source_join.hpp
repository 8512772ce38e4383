#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <vector>

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
  double median() const {
    if (ages_.empty()) return 0.0;
    std::vector<float> sorted = ages_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return static_cast<double>(*middle);
  }

 private:
  std::vector<float> ages_;
};

/// Joins rows of sources with clocks and rates of their own: each row of one source, the joints',
/// gets the latest values of the others that were measured not later. Values older than
/// `stale_after` are missing (NaN). Rows may arrive late or in another order than they were
/// measured, by up to `arrival_window`; memory does not depend on their number, but for four bytes
/// per row and source for the median age.
class SourceJoin {
 public:
  /// How far apart rows of one time may arrive (s).
  static constexpr double arrival_window = 0.5;
  /// Rows of the joints that arrive in another order than they were measured are sorted, if they
  /// are late by at most this (s). A larger step back is one of the clock.
  static constexpr double largest_disorder = 0.1;

  struct Config {
    /// Where the numbers of each source's rows are in a joined row.
    std::vector<std::vector<std::size_t>> columns;
    std::size_t clock = 0;      ///< the source that gives the rows
    double stale_after = 0.05;  ///< s
  };

  /// What became of one source's rows.
  struct Report {
    std::uint64_t rows = 0;
    double first = 0.0;       ///< time of the first row (s)
    double last = 0.0;        ///< time of the last row (s)
    Ages ages;                ///< of values in joined rows
    std::uint64_t stale = 0;  ///< joined rows without a value of this source
  };

  explicit SourceJoin(Config config);

  /// Adds a row of a source, after all rows that are due were popped. `arrival` must not decrease
  /// from call to call, over all sources. A row without a finite time is left out.
  void add(std::size_t source, double arrival, double time, std::span<const double> row,
           std::uint64_t position);
  /// No row follows: all are due.
  void finish() { is_finished_ = true; }
  /// Writes the next joined row that is due. Returns false if none is.
  bool pop(std::vector<double>& row);
  /// That of the joints' row that was popped last.
  std::uint64_t position() const { return position_; }

  const Report& report(std::size_t source) const { return sources_[source].report; }
  std::uint64_t rows() const { return rows_; }
  /// Rows of the joints before every other source had a value; they are left out.
  std::uint64_t rows_before() const { return rows_before_; }

 private:
  struct Held {
    double arrival = 0.0;
    std::vector<double> row;
  };
  using ByTime = std::multimap<double, Held>;
  struct Source {
    ByTime held;
    std::deque<ByTime::iterator> by_arrival;
    bool has_begun = false;
    Report report;
  };
  struct Pending {
    double arrival = 0.0;
    double time = 0.0;
    std::uint64_t position = 0;
    std::vector<double> row;
  };

  void insert(Pending pending);
  bool join(const Pending& pending, std::vector<double>& row);
  bool hold(std::size_t source, double time, std::vector<double>& row);
  void forget_old();

  Config config_;
  std::size_t width_ = 0;
  std::vector<Source> sources_;
  std::deque<Pending> pending_;
  double arrival_ = 0.0;    ///< of the latest row …
  std::size_t latest_ = 0;  ///< … and its source
  bool is_finished_ = false;
  std::uint64_t position_ = 0;
  std::uint64_t rows_ = 0;
  std::uint64_t rows_before_ = 0;
};

}  // namespace touchdown::logs
