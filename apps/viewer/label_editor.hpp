#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "logs/log/label_edits.hpp"

namespace touchdown::viewer {

/// What a person edits: an edge of a wheel, where begin and end are the same, or an interval.
struct LabelSelection {
  std::size_t wheel = 0;
  logs::TimeRange range;

  bool is_edge() const { return range.begin == range.end; }
};

/// The times of a log's steps (s), which may jitter or have gaps.
class LogClock {
 public:
  /// One step at least. Times that do not increase are a microsecond later than those before.
  LogClock(std::vector<double> times, double period);

  std::size_t steps() const { return times_.size(); }
  double period() const { return period_; }
  /// The first step that is not before `time`, at most the number of steps.
  std::size_t step_at(double time) const;
  /// Its inverse: the end of the last step from the number of steps on.
  double time_of(std::size_t step) const;
  logs::TimeRange range() const { return {times_.front(), time_of(steps())}; }

 private:
  std::vector<double> times_;
  double period_;
};

/// Edits the labels of a log and writes the file after each edit. Edges are at steps of the log. It
/// has no window: keys and mouse call it.
class LabelEditor {
 public:
  /// `labels.file` is written.
  LabelEditor(logs::ContactIntervals labels, LogClock clock);

  const LogClock& clock() const { return clock_; }

  /// The labels, with an edge that is being dragged.
  const logs::ContactIntervals& labels() const { return dragged_ ? preview_ : history_.labels(); }
  std::size_t wheel() const { return wheel_; }
  const std::optional<LabelSelection>& selection() const { return selection_; }
  /// Where an interval begins that is being marked.
  std::optional<double> mark() const { return mark_; }

  // Selecting. What moves to another time returns it.
  void select_interval(std::size_t wheel, double time);
  /// The edge that is nearest to `time`, at most `tolerance` (s) away.
  bool select_edge(std::size_t wheel, double time, double tolerance);
  void change_wheel() { select_wheel(1 - wheel_); }
  std::optional<double> next_edge(double present, bool back);
  std::optional<double> next_least_sure(bool back);
  void mark_begin(double time);

  // Editing.
  /// Sets the time from the mark to `present`, else the selected interval, else the one at
  /// `present`.
  void set(logs::LabelState state, bool both_wheels, double present);
  void split(double time);
  /// Moves the selected edge by steps and returns where it is.
  std::optional<double> nudge(int steps);
  /// Moves the selected edge with the mouse, until `drop`.
  void drag(double to);
  void drop();
  /// Accepts the interval of `next_least_sure`, else the selected one; returns the next one to look
  /// at.
  std::optional<double> accept();
  bool undo() { return saved_if(history_.undo()); }
  bool redo() { return saved_if(history_.redo()); }

  /// Why the labels could not be written; empty if they were.
  const std::string& problem() const { return problem_; }
  /// What was changed and saved, for the end. Errors: `Error` if it cannot be written.
  std::string finish();

 private:
  struct Drag {
    std::size_t wheel;
    double edge;
  };

  void select_wheel(std::size_t wheel);
  bool has_edge(std::size_t wheel, double time) const;
  bool saved_if(bool has_changed);
  void take(logs::ContactIntervals edited);
  void save();
  void follow_edge(double from, double to);

  logs::ContactIntervals preview_;
  logs::LabelHistory history_;
  LogClock clock_;
  std::size_t wheel_ = 0;
  std::optional<LabelSelection> selection_;
  std::optional<double> mark_;
  std::optional<Drag> dragged_;
  std::optional<logs::TimeRange> looked_at_;  ///< the interval of `next_least_sure`
  double looked_at_sure_ = -1.0;
  bool is_changed_ = false;
  std::string problem_;
};

}  // namespace touchdown::viewer
