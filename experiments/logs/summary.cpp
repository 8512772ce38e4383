#include "experiments/logs/summary.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "recordings/recording.hpp"

namespace touchdown::experiments {

namespace {

constexpr std::size_t most_listed = 8;

std::string percent(std::int64_t part, std::int64_t whole) {
  return fmt::format("{:.1f} %", 100.0 * scoring::ratio(part, whole));
}

std::string found(const scoring::TransitionCounts& counts, std::string_view name) {
  std::string text = fmt::format("{} {} of {} found", name, counts.detected, counts.events);
  if (counts.detected > 0) {
    text += fmt::format(", latency {:.1f}", 1e3 * counts.latency_mean());
    if (counts.detected > 1) text += fmt::format(" ± {:.1f}", 1e3 * counts.latency_deviation());
    text += " ms";
  }
  return text + fmt::format(", {} false", counts.false_alarms);
}

std::string score_text(const scoring::Score& score) {
  return fmt::format(
      "{:<12} accuracy {:.4f}, precision and recall of contact {:.4f} {:.4f}, of no contact {:.4f} "
      "{:.4f}, Brier {:.4f}\n{:<12} {}; {}\n",
      "truth", score.points.success(), score.points.contact_precision(),
      score.points.contact_recall(), score.points.no_contact_precision(),
      score.points.no_contact_recall(), score.calibration.brier(), "",
      found(score.takeoff, "takeoffs"), found(score.landing, "landings"));
}

}  // namespace

void LogSummary::Events::add(double time) {
  ++count;
  if (first.size() < most_listed) first.push_back(time);
}

std::string LogSummary::Events::text() const {
  if (count == 0) return "none";
  std::string text = fmt::format("{:.3f}", fmt::join(first, ", "));
  if (count > static_cast<std::int64_t>(first.size())) text += fmt::format(" … ({} in all)", count);
  return text;
}

void LogSummary::Clock::add(double time) {
  if (!std::isfinite(time)) return;
  if (std::isnan(previous)) {
    first = last = time;
  } else {
    // A record with a delay below half a step does not count as lost.
    if (time - previous > 1.5 * period) lost += time - previous - period;
    if (time < previous) ++steps_back;
  }
  first = std::fmin(first, time);
  last = std::fmax(last, time);
  previous = time;
}

std::string LogSummary::Clock::text(double start) const {
  if (std::isnan(previous)) return "no finite value";
  std::string text = fmt::format("from {:.3f} to {:.3f} s", first, last);
  if (start != 0.0) text += fmt::format(", 0 being {:.3f} s of the log's clock", start);
  if (lost > 0.0) text += fmt::format("; {:.3f} s without records", lost);
  if (steps_back > 0) {
    text += fmt::format("; it goes back {} time{}", steps_back, steps_back == 1 ? "" : "s");
  }
  return text;
}

LogSummary::LogSummary(double period, const scoring::ScoringConfig& scoring)
    : clock_{period, NAN, NAN, NAN}, skipped_(std::llround(scoring.skip / period)) {}

void LogSummary::add(double time, const Belief& belief) {
  clock_.add(time);
  if (belief.status == SignalStatus::invalid && belief.unusable != SignalIndex::none) {
    ++unusable_[static_cast<std::size_t>(belief.unusable)];
  }
  ++status_[static_cast<std::size_t>(belief.status)];
  const std::array<bool, 2> now = {belief.wheel[0].contact, belief.wheel[1].contact};
  if (steps_ >= skipped_) {
    const auto views = scoring::views_of(belief);
    for (std::size_t v = 0; v < scoring::view_count; ++v) contact_[v] += views[v].contact ? 1 : 0;
    for (std::size_t wheel = 0; wheel < 2 && steps_ > skipped_; ++wheel) {
      if (now[wheel] == was_in_contact_[wheel]) continue;
      (now[wheel] ? landings_ : takeoffs_)[wheel].add(time);
    }
  }
  was_in_contact_ = now;
  ++steps_;
}

std::string LogSummary::contact_text() const {
  const std::int64_t counted = std::max<std::int64_t>(steps_ - skipped_, 0);
  if (counted == 0) return "too short to count";
  return fmt::format("left {}, right {}, any wheel {}, both {}", percent(contact_[0], counted),
                     percent(contact_[1], counted), percent(contact_[2], counted),
                     percent(contact_[3], counted));
}

std::string LogSummary::events_text(std::size_t wheel) const {
  if (takeoffs_[wheel].count + landings_[wheel].count == 0) return "no takeoff, no landing";
  return fmt::format("takeoffs at (s) {}; landings at (s) {}", takeoffs_[wheel].text(),
                     landings_[wheel].text());
}

std::string LogSummary::signals_text() const {
  if (status_[0] == steps_) return "all good";
  std::vector<std::string> parts;
  for (const SignalStatus status :
       {SignalStatus::invalid, SignalStatus::gap, SignalStatus::frozen}) {
    const std::int64_t count = status_[static_cast<std::size_t>(status)];
    if (count > 0) parts.push_back(fmt::format("{} {}", count, to_text(status)));
  }
  std::string text = fmt::format("{} of {} steps", fmt::join(parts, ", "), steps_);
  const auto most = std::max_element(unusable_.begin(), unusable_.end());
  if (*most > 0) {
    const auto signal = static_cast<SignalIndex>(most - unusable_.begin());
    const auto kinds = std::count_if(unusable_.begin(), unusable_.end(),
                                     [](std::int64_t steps) { return steps > 0; });
    text += fmt::format("; unusable: {}{}", to_text(signal),
                        kinds == 1 ? "" : fmt::format(" and {} others", kinds - 1));
  }
  return text;
}

std::string LogSummary::text(const std::optional<scoring::RobotScore>& score, double start) const {
  std::string text =
      fmt::format("{:<12} {}\n{:<12} {}\n{:<12} {}\n{:<12} {}\n{:<12} {}\n", "time",
                  clock_.text(start), "contact", contact_text(), "left wheel", events_text(0),
                  "right wheel", events_text(1), "signals", signals_text());
  if (score) text += score_text(score->wheels());
  return text;
}

}  // namespace touchdown::experiments
