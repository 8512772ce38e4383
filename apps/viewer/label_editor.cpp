#include "apps/viewer/label_editor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/results/captions.hpp"

namespace touchdown::viewer {

using logs::ContactInterval;
using logs::ContactIntervals;
using logs::LabelState;
using logs::TimeRange;

LogClock::LogClock(std::vector<double> times, double period)
    : times_(std::move(times)), period_(period) {
  for (std::size_t k = 0; k < times_.size(); ++k) {
    times_[k] = logs::to_microsecond(times_[k]);
    if (k > 0 && !(times_[k] > times_[k - 1])) {
      times_[k] = logs::to_microsecond(times_[k - 1] + 1e-6);
    }
  }
}

std::size_t LogClock::step_at(double time) const {
  const auto at = std::lower_bound(times_.begin(), times_.end(), logs::to_microsecond(time));
  return static_cast<std::size_t>(at - times_.begin());
}

double LogClock::time_of(std::size_t step) const {
  return step < times_.size() ? times_[step] : logs::to_microsecond(times_.back() + period_);
}

LabelEditor::LabelEditor(ContactIntervals labels, LogClock clock)
    : history_(std::move(labels)), clock_(std::move(clock)) {}

void LabelEditor::select_wheel(std::size_t wheel) {
  wheel_ = wheel;
  if (!selection_) return;
  selection_->wheel = wheel;
  const double edge = selection_->range.begin;
  if (selection_->is_edge() && !has_edge(wheel, edge)) select_interval(wheel, edge);
}

bool LabelEditor::has_edge(std::size_t wheel, double time) const {
  const std::vector<double> edges = logs::edges_of(labels(), wheel);
  return std::binary_search(edges.begin(), edges.end(), time);
}

void LabelEditor::select_interval(std::size_t wheel, double time) {
  wheel_ = wheel;
  looked_at_.reset();
  selection_ = LabelSelection{wheel, logs::range_at(labels(), time, wheel, clock_.range())};
}

bool LabelEditor::select_edge(std::size_t wheel, double time, double tolerance) {
  const std::vector<double> edges = logs::edges_of(labels(), wheel);
  const auto nearest = std::min_element(edges.begin(), edges.end(), [time](double a, double b) {
    return std::abs(a - time) < std::abs(b - time);
  });
  if (nearest == edges.end() || std::abs(*nearest - time) > tolerance) return false;
  wheel_ = wheel;
  selection_ = LabelSelection{wheel, {*nearest, *nearest}};
  return true;
}

std::optional<double> LabelEditor::next_edge(double present, bool back) {
  const std::vector<double> edges = logs::edges_of(labels(), wheel_);
  const bool from_edge = selection_ && selection_->is_edge();
  const bool from_interval = selection_ && !selection_->is_edge();
  double from = logs::to_microsecond(present);
  if (from_edge) from = selection_->range.begin;
  if (from_interval) from = back ? selection_->range.begin : selection_->range.end;
  std::optional<double> found;
  for (const double edge : edges) {
    const bool is_here = edge == from && from_interval;
    if (back ? edge < from || is_here : edge > from || is_here) {
      found = edge;
      if (!back) break;
    }
  }
  if (found) selection_ = LabelSelection{wheel_, {*found, *found}};
  return found;
}

std::optional<double> LabelEditor::next_least_sure(bool back) {
  const std::vector<ContactInterval>& rows = labels().intervals;
  const std::vector<std::size_t> order = logs::least_sure(labels());
  if (order.empty()) {
    looked_at_.reset();
    return std::nullopt;
  }
  // The place of the one before, which may have been accepted or edited.
  const auto is_before = [&](std::size_t i) {
    const double start = looked_at_ ? looked_at_->begin : clock_.range().begin;
    return std::pair(*rows[i].sure, rows[i].start) < std::pair(looked_at_sure_, start);
  };
  auto next = std::find_if_not(order.begin(), order.end(), is_before);
  const bool is_here = next != order.end() && looked_at_ && rows[*next].start == looked_at_->begin;
  if (back) {
    next = std::prev(next == order.begin() ? order.end() : next);
  } else if (is_here) {
    ++next;
  }
  if (next == order.end()) next = order.begin();
  const ContactInterval& row = rows[*next];
  looked_at_ = TimeRange{row.start, row.end};
  looked_at_sure_ = *row.sure;
  if (!has_edge(wheel_, row.start) && !has_edge(wheel_, row.end)) wheel_ = 1 - wheel_;
  selection_ = LabelSelection{wheel_, *looked_at_};
  return row.start;
}

void LabelEditor::mark_begin(double time) {
  const double here = clock_.time_of(clock_.step_at(time));
  mark_ = mark_ == here ? std::nullopt : std::optional(here);
}

void LabelEditor::set(LabelState state, bool both_wheels, double present) {
  const double here = clock_.time_of(clock_.step_at(present));
  TimeRange range;
  if (mark_) {
    range = {std::min(*mark_, here), std::max(*mark_, here)};
  } else if (selection_ && !selection_->is_edge()) {
    range = selection_->range;
  } else {
    range = logs::range_at(labels(), here, wheel_, clock_.range());
  }
  mark_.reset();
  logs::Wheels wheels = {both_wheels, both_wheels};
  wheels.at(wheel_) = true;
  ContactIntervals edited = history_.labels();
  logs::set_state(edited, range, wheels, state);
  take(std::move(edited));
  selection_ =
      LabelSelection{wheel_, logs::range_at(labels(), range.begin, wheel_, clock_.range())};
}

void LabelEditor::split(double time) {
  ContactIntervals edited = history_.labels();
  logs::split(edited, clock_.time_of(clock_.step_at(time)));
  take(std::move(edited));
  select_edge(wheel_, time, clock_.period());
}

std::optional<double> LabelEditor::nudge(int steps) {
  if (!selection_ || !selection_->is_edge()) return std::nullopt;
  const double edge = selection_->range.begin;
  const auto step = static_cast<std::ptrdiff_t>(clock_.step_at(edge)) + steps;
  const auto last = static_cast<std::ptrdiff_t>(clock_.steps());
  drag(clock_.time_of(static_cast<std::size_t>(std::clamp(step, std::ptrdiff_t{0}, last))));
  drop();
  return selection_->range.begin;
}

void LabelEditor::drag(double to) {
  if (!selection_ || !selection_->is_edge()) return;
  if (!dragged_) dragged_ = Drag{selection_->wheel, selection_->range.begin};
  preview_ = history_.labels();
  std::size_t step = clock_.step_at(to);
  if (step > 0 && clock_.time_of(step) - to > to - clock_.time_of(step - 1)) --step;
  const double at = logs::move_edge(preview_, dragged_->wheel, dragged_->edge, clock_.time_of(step),
                                    clock_.period(), clock_.range());
  selection_->range = {at, at};
}

void LabelEditor::drop() {
  if (!dragged_) return;
  const double from = std::exchange(dragged_, std::nullopt)->edge;
  follow_edge(from, selection_->range.begin);
  take(std::move(preview_));
}

/// The interval that is looked at keeps its edges.
void LabelEditor::follow_edge(double from, double to) {
  if (!looked_at_) return;
  if (looked_at_->begin == from) looked_at_->begin = to;
  if (looked_at_->end == from) looked_at_->end = to;
}

std::optional<double> LabelEditor::accept() {
  ContactIntervals edited = history_.labels();
  if (looked_at_) {
    logs::accept(edited, *looked_at_);
  } else if (selection_ && !selection_->is_edge()) {
    logs::accept(edited, selection_->range);
  }
  take(std::move(edited));
  return next_least_sure(false);
}

bool LabelEditor::saved_if(bool has_changed) {
  if (!has_changed) return false;
  selection_.reset();
  save();
  return true;
}

void LabelEditor::take(ContactIntervals edited) {
  if (history_.edit(std::move(edited))) save();
}

void LabelEditor::save() {
  is_changed_ = true;
  try {
    write_atomically(labels().file, logs::to_csv(labels()));
    problem_.clear();
  } catch (const Error& error) {
    problem_ = error.what();
  }
}

std::string LabelEditor::finish() {
  drop();
  if (!is_changed_) return fmt::format("{}: not changed\n", labels().file);
  if (!problem_.empty()) save();
  if (!problem_.empty()) throw Error(problem_);
  double seconds = 0.0;
  for (const ContactInterval& one : labels().intervals) seconds += one.end - one.start;
  return fmt::format("{}: {} saved; {}, {:.3f} s, {} to look at\n", labels().file,
                     experiments::plural(history_.edits(), "edit"),
                     experiments::plural(labels().intervals.size(), "interval"), seconds,
                     logs::least_sure(labels()).size());
}

}  // namespace touchdown::viewer
