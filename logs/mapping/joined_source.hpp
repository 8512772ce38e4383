#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/table.hpp"
#include "logs/bags/source_join.hpp"
#include "logs/log/contact_intervals.hpp"
#include "logs/mapping/row_source.hpp"

namespace touchdown::logs {

/// Several sources with clocks of their own, joined at the joints' clock.
class JoinedSource : public RowSource {
 public:
  std::span<const SourceNames> names() const final { return names_; }

  void select(const LogMapping& mapping) final {
    clock_ = mapping.joint_source();
    columns_.resize(names_.size());
    for (std::size_t i = 0; i < mapping.columns.size(); ++i) {
      columns_[mapping.columns[i].source].push_back(i);
    }
    join_.emplace(read(mapping), SourceJoin::Config{columns_, clock_, are_topics(), stale_after_});
    for (std::size_t i = 0; i < names_.size(); ++i) {
      require_order(i);
      note_left_out(i);
    }
    if (!are_topics()) require_equal_restarts();
  }

  bool next(std::vector<double>& row) final {
    if (join_->next(row)) return true;
    require_joined();
    for (std::size_t i = 0; i < names_.size(); ++i) note_ages(i);
    if (join_->rows_before() > 0) {
      warn(clock_, fmt::format("{} rows before the first of the other sources are left out",
                               join_->rows_before()));
    }
    return false;
  }

 protected:
  JoinedSource(std::filesystem::path log, double stale_after, LogNotes& notes)
      : RowSource(notes), log_(std::move(log)), stale_after_(stale_after) {}

  /// All rows of each source, with the values of `columns`.
  virtual std::vector<SourceRows> read(const LogMapping& mapping) = 0;

  /// One line for each source whose clock is another one than the joints'.
  virtual std::vector<std::string> clock_notes() const { return {}; }

  /// Of each source, where its columns are in the mapping's rows.
  const std::vector<std::vector<std::size_t>>& columns() const { return columns_; }
  double stale_after() const { return stale_after_; }
  std::size_t clock() const { return clock_; }
  /// The number of the joints' row among those of its source, from 1.
  std::uint64_t position() const { return join_->position(); }

  std::filesystem::path log_;
  std::vector<SourceNames> names_;

 private:
  bool are_topics() const { return names_[clock_].is_topic; }
  const char* row_name() const { return are_topics() ? "message" : "row"; }

  /// Errors: `InputError` for a source of which the times do not follow each other.
  void require_order(std::size_t source) const {
    const ClockSteps& steps = join_->report(source).steps;
    if (!steps.is_scrambled) return;
    throw InputError(fmt::format(
        "{}: times of {} go back {} times, first at {} {} (to {} s): {}", log_.string(),
        names_[source].file, steps.steps_back, row_name(), steps.first_back.position,
        exact(to_microsecond(steps.first_back.time)),
        are_topics() ? "do publishers with clocks of their own share the topic? `time: {from: "
                       "log_time}` takes the times of recording"
                     : "sort its rows by time"));
  }

  /// Errors: `InputError` if one source started again where another one did not.
  void require_equal_restarts() const {
    const std::vector<std::uint64_t>& expected = join_->report(clock_).steps.restarts;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const std::vector<std::uint64_t>& restarts = join_->report(i).steps.restarts;
      if (restarts.size() == expected.size() || join_->source(i).rows.empty()) continue;
      const auto text = [](const std::vector<std::uint64_t>& rows) {
        return rows.empty() ? "nowhere" : fmt::format("at row {}", fmt::join(rows, ", "));
      };
      throw InputError(fmt::format(
          "{}: the clock of {} starts again {}, that of {} {}, so that it is unknown which rows "
          "belong together: split the files there, or remove rows with wrong times",
          log_.string(), names_[clock_].file, text(expected), names_[i].file, text(restarts)));
    }
  }

  void warn(std::size_t source, const std::string& what) const {
    notes().warnings.push_back(fmt::format("{}: {}", names_[source].file, what));
  }

  void note_left_out(std::size_t source) const {
    const SourceRows& rows = join_->source(source);
    const ClockSteps& steps = join_->report(source).steps;
    const std::size_t with_time = rows.rows.size() + steps.left_out;
    if (rows.without_time > 0) {
      warn(source, fmt::format("{} of {} {}s without a time are left out, first {} {}",
                               rows.without_time, rows.without_time + with_time, row_name(),
                               row_name(), rows.first_without_time));
    }
    if (steps.left_out > 0) {
      warn(source, fmt::format("{} of {} {}s are left out because times around theirs contradict "
                               "them, first {} {} ({} s)",
                               steps.left_out, with_time, row_name(), row_name(),
                               steps.first_left_out.position,
                               exact(to_microsecond(steps.first_left_out.time))));
    }
  }

  /// How old the source's values are where they are held. Most rows without one are a finding.
  void note_ages(std::size_t source) const {
    if (names_[source].file == names_[clock_].file) return;
    const SourceJoin::Report& report = join_->report(source);
    const std::string& joints = names_[clock_].file;
    warn(source,
         fmt::format(
             "held at the rows of {}, ages {:.1f} ms (median) to {:.1f} ms{}", joints,
             1e3 * report.ages.median(), 1e3 * report.ages.largest(),
             report.stale == 0
                 ? std::string()
                 : fmt::format("; missing at {} of {} rows, where it is older than {:.0f} ms",
                               report.stale, join_->rows(), 1e3 * stale_after_)));
    const auto all = static_cast<double>(join_->rows_before() + join_->rows());
    const double joined = static_cast<double>(join_->rows() - report.stale);
    // Labels may be of a part of the log.
    if (names_[source].section == "contact" || 2.0 * joined >= all) return;
    notes().findings.push_back(fmt::format(
        "{} has values at {:.1f} % of the rows of {}: do both cover one time, by one clock?",
        names_[source].file, 100.0 * joined / all, joints));
  }

  /// Errors: `InputError` if no row was joined.
  void require_joined() const {
    if (join_->rows() > 0) return;
    std::vector<std::string> spans;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const SourceJoin::Report& report = join_->report(i);
      const std::size_t rows = join_->source(i).rows.size();
      spans.push_back(rows == 0 ? fmt::format("{} has no rows with a time", names_[i].file)
                                : fmt::format("{} has {} rows from {:.3f} to {:.3f} s",
                                              names_[i].file, rows, report.first, report.last));
    }
    std::vector<std::string> causes = clock_notes();
    if (causes.empty()) {
      causes.push_back(fmt::format(
          "are their times of one clock and one unit?{}",
          names_[clock_].is_topic ? " `time: {from: log_time}` takes the times of recording" : ""));
    }
    throw InputError(fmt::format(
        "{}: no row of {} has values of the other sources that are at most {:.0f} ms old: {}: {}",
        log_.string(), names_[clock_].file, 1e3 * stale_after_, fmt::join(spans, ", "),
        fmt::join(causes, "; ")));
  }

  double stale_after_;
  std::vector<std::vector<std::size_t>> columns_;
  std::size_t clock_ = 0;
  std::optional<SourceJoin> join_;
};

/// Files of one folder as sources. `log` is the folder, or one of them.
std::unique_ptr<RowSource> join_files(const std::filesystem::path& log, const LogSources& sources,
                                      LogNotes& notes);

}  // namespace touchdown::logs
