#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "logs/log/contact_intervals.hpp"

/// How a person edits contact labels. Labels are values: an edit changes a copy, and what was
/// before is kept to be undone. All times are rounded to the microsecond.
namespace touchdown::logs {

enum class LabelState : int { unknown, air, contact };

/// Flags of the left and right wheel.
using Wheels = std::array<bool, models::wheel_count>;

/// The time [begin, end) (s).
struct TimeRange {
  double begin = 0.0, end = 0.0;

  bool operator==(const TimeRange&) const = default;
};

LabelState state_at(const ContactIntervals& labels, double time, std::size_t wheel);

/// The ends of a wheel's states, in order: where its contact changes, begins or ends to be known,
/// and where an interval was split.
std::vector<double> edges_of(const ContactIntervals& labels, std::size_t wheel);

/// The time between the edges of a wheel around `time`, within `log`.
TimeRange range_at(const ContactIntervals& labels, double time, std::size_t wheel,
                   const TimeRange& log);

/// Sets the state of some wheels. `unknown` is for both wheels at once, so time that was unknown
/// gets the state for both, too. Intervals that touch at an end of the range and have equal contact
/// become one, as sure as the less sure of them.
void set_state(ContactIntervals& labels, const TimeRange& range, const Wheels& wheels,
               LabelState state);

/// Moves an edge of a wheel and returns where it is. It stops one `step` (s) before a neighbour and
/// at the ends of `log`, so no interval vanishes. An edge to unknown time is one of both wheels and
/// stops at the edges of both.
double move_edge(ContactIntervals& labels, std::size_t wheel, double edge, double to, double step,
                 const TimeRange& log);

/// Makes two intervals of the one that contains `time`, of equal contact.
void split(ContactIntervals& labels, double time);

/// A person has looked at the intervals within the range and leaves them.
void accept(ContactIntervals& labels, const TimeRange& range);

/// The intervals that a person should look at, the least sure first: their numbers.
std::vector<std::size_t> least_sure(const ContactIntervals& labels);

/// Labels with those before and after each edit.
class LabelHistory {
 public:
  explicit LabelHistory(ContactIntervals labels);

  const ContactIntervals& labels() const { return labels_; }
  /// Takes an edited copy. Returns false if it is no other.
  bool edit(ContactIntervals edited);
  /// Returns false if there is none.
  bool undo() { return bring(undone_, redone_); }
  bool redo() { return bring(redone_, undone_); }
  /// Edits that are neither undone nor replaced.
  std::size_t edits() const { return undone_.size(); }

 private:
  /// Brings the last labels of one list, and keeps those so far in the other.
  bool bring(std::vector<ContactIntervals>& from, std::vector<ContactIntervals>& to);

  ContactIntervals labels_;
  std::vector<ContactIntervals> undone_, redone_;  ///< labels that undo and redo bring
};

}  // namespace touchdown::logs
