#include "logs/log/label_edits.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace touchdown::logs {

namespace {

using Rows = std::vector<ContactInterval>;

/// The first interval that ends after `time`.
Rows::iterator first_until(Rows& rows, double time) {
  return std::ranges::upper_bound(rows, time, {}, &ContactInterval::end);
}

/// Makes one interval of two that touch at `time` and have equal contact.
void join_at(Rows& rows, double time) {
  const auto after = std::ranges::find(rows, time, &ContactInterval::start);
  if (after == rows.begin() || after == rows.end()) return;
  ContactInterval& before = *std::prev(after);
  if (before.end != time || before.contact != after->contact) return;
  if (!before.sure || (after->sure && *after->sure < *before.sure)) before.sure = after->sure;
  before.end = after->end;
  rows.erase(after);
}

/// Fills the unknown time of the range with intervals of this contact.
void fill(Rows& rows, const TimeRange& range, bool contact) {
  double begin = range.begin;
  for (auto one = first_until(rows, begin); begin < range.end; ++one) {
    const double end = one == rows.end() ? range.end : std::min(one->start, range.end);
    if (begin < end) one = std::next(rows.insert(one, {begin, end, {contact, contact}}));
    if (one == rows.end()) return;
    begin = one->end;
  }
}

/// The edge before `edge` and the one after it; infinite without one.
TimeRange neighbours(const std::vector<double>& edges, double edge) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto before = std::lower_bound(edges.begin(), edges.end(), edge);
  const auto after = std::upper_bound(edges.begin(), edges.end(), edge);
  return {before == edges.begin() ? -infinity : *std::prev(before),
          after == edges.end() ? infinity : *after};
}

}  // namespace

LabelState state_at(const ContactIntervals& labels, double time, std::size_t wheel) {
  const ContactInterval* const one = labels.at(time);
  if (one == nullptr || to_microsecond(time) >= one->end) return LabelState::unknown;
  return one->contact.at(wheel) ? LabelState::contact : LabelState::air;
}

std::vector<double> edges_of(const ContactIntervals& labels, std::size_t wheel) {
  std::set<double> edges;
  const Rows& rows = labels.intervals;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool touches = i > 0 && rows[i - 1].end == rows[i].start;
    // Where only the other wheel's contact changes there is no edge.
    const bool goes_on = touches && rows[i - 1].contact != rows[i].contact &&
                         rows[i - 1].contact.at(wheel) == rows[i].contact.at(wheel);
    if (goes_on) {
      edges.erase(rows[i].start);
    } else {
      edges.insert(rows[i].start);
    }
    edges.insert(rows[i].end);
  }
  return {edges.begin(), edges.end()};
}

TimeRange range_at(const ContactIntervals& labels, double time, std::size_t wheel,
                   const TimeRange& log) {
  TimeRange range = log;
  for (const double edge : edges_of(labels, wheel)) {
    if (edge <= time) range.begin = std::max(range.begin, edge);
    if (edge > time) range.end = std::min(range.end, edge);
  }
  return range;
}

void split(ContactIntervals& labels, double time) {
  time = to_microsecond(time);
  const auto one = first_until(labels.intervals, time);
  if (one == labels.intervals.end() || one->start >= time) return;
  ContactInterval before = *one;
  before.end = time;
  one->start = time;
  labels.intervals.insert(one, before);
}

void set_state(ContactIntervals& labels, const TimeRange& given, const Wheels& wheels,
               LabelState state) {
  const TimeRange range{to_microsecond(given.begin), to_microsecond(given.end)};
  if (!(range.begin < range.end)) return;
  Rows& rows = labels.intervals;
  split(labels, range.begin);
  split(labels, range.end);
  const auto is_within = [&](const ContactInterval& one) {
    return one.start >= range.begin && one.end <= range.end;
  };
  if (state == LabelState::unknown) {
    std::erase_if(rows, is_within);
    return;
  }
  fill(rows, range, state == LabelState::contact);
  std::vector<double> joints = {range.begin, range.end};
  for (ContactInterval& one : rows) {
    if (!is_within(one)) continue;
    for (std::size_t wheel = 0; wheel < wheels.size(); ++wheel) {
      if (wheels.at(wheel)) one.contact.at(wheel) = state == LabelState::contact;
    }
    one.sure.reset();
    joints.push_back(one.start);
  }
  for (const double joint : joints) join_at(rows, joint);
}

double move_edge(ContactIntervals& labels, std::size_t wheel, double edge, double to, double step,
                 const TimeRange& log) {
  edge = to_microsecond(edge);
  Rows& rows = labels.intervals;
  const auto before = std::ranges::find(rows, edge, &ContactInterval::end);
  const auto after = std::ranges::find(rows, edge, &ContactInterval::start);
  const bool has_before = before != rows.end();
  const bool has_after = after != rows.end();
  if (!has_before && !has_after) return edge;
  // Unknown time and splits are of both wheels.
  const bool is_of_both = !has_before || !has_after || before->contact == after->contact;
  TimeRange free = neighbours(edges_of(labels, wheel), edge);
  if (is_of_both) {
    const TimeRange other = neighbours(edges_of(labels, 1 - wheel), edge);
    free = {std::max(free.begin, other.begin), std::min(free.end, other.end)};
  }
  const double first = std::max(free.begin + step, log.begin);
  const double last = std::min(free.end - step, log.end);
  if (!(first <= last)) return edge;
  to = to_microsecond(std::clamp(to, first, last));
  if (is_of_both) {
    if (has_before) before->end = to;
    if (has_after) after->start = to;
  } else {
    Wheels wheels{};
    wheels.at(wheel) = true;
    const bool contact = (to > edge ? before : after)->contact.at(wheel);
    set_state(labels, {std::min(edge, to), std::max(edge, to)}, wheels,
              contact ? LabelState::contact : LabelState::air);
  }
  return to;
}

void accept(ContactIntervals& labels, const TimeRange& range) {
  for (ContactInterval& one : labels.intervals) {
    if (one.start >= range.begin && one.end <= range.end) one.sure.reset();
  }
}

std::vector<std::size_t> least_sure(const ContactIntervals& labels) {
  const Rows& rows = labels.intervals;
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) { return rows[i].sure.value_or(1.0) >= 1.0; });
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t k) { return rows[i].sure < rows[k].sure; });
  return order;
}

LabelHistory::LabelHistory(ContactIntervals labels) : labels_(std::move(labels)) {
  for (ContactInterval& one : labels_.intervals) {
    one.start = to_microsecond(one.start);
    one.end = to_microsecond(one.end);
  }
  std::erase_if(labels_.intervals, [](const ContactInterval& one) { return one.start >= one.end; });
}

bool LabelHistory::edit(ContactIntervals edited) {
  if (edited.intervals == labels_.intervals) return false;
  undone_.push_back(std::exchange(labels_, std::move(edited)));
  redone_.clear();
  return true;
}

bool LabelHistory::bring(std::vector<ContactIntervals>& from, std::vector<ContactIntervals>& to) {
  if (from.empty()) return false;
  to.push_back(std::exchange(labels_, std::move(from.back())));
  from.pop_back();
  return true;
}

}  // namespace touchdown::logs
