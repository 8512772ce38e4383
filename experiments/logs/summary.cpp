#include "experiments/logs/summary.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/compile.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "estimator/signal_guard.hpp"
#include "logs/bags/topic_rows.hpp"

namespace touchdown::experiments {

namespace {

constexpr std::size_t most_listed = 8;

std::string percent(std::int64_t part, std::int64_t whole) {
  return fmt::format("{:.1f} %", 100.0 * scoring::ratio(part, whole));
}

/// The events of the truth: flights that last long enough. `listed` is the number of those in the
/// list, which merges shorter states, so that the text accounts for each.
std::string found(const scoring::TransitionCounts& counts, std::int64_t listed,
                  std::string_view name) {
  std::string text = fmt::format("{} {} of {} found", name, counts.detected, counts.events);
  if (counts.detected > 0) {
    text += fmt::format(", latency {:.1f}", 1e3 * counts.latency_mean());
    if (counts.detected > 1) text += fmt::format(" ± {:.1f}", 1e3 * counts.latency_deviation());
    text += " ms";
  }
  text += fmt::format(", {} false", counts.false_alarms);
  const std::int64_t others = listed - counts.detected - counts.false_alarms;
  if (others > 0) text += fmt::format(", {} in or beside a shorter or unscored flight", others);
  if (others < 0) {
    text += fmt::format(", {} of these before a state under {:g} ms and not listed", -others,
                        1e3 * scoring::ScoringConfig{}.minimum_flight);
  }
  return text;
}

/// Landings that are all found late by the same time: an impact shows at once.
std::string shift_text(const scoring::TransitionCounts& landing) {
  constexpr std::int64_t few = 3;
  constexpr double least = 0.03;  // s
  constexpr double alike = 0.005;
  const bool is_shifted = landing.detected >= few && landing.latency_deviation() < alike &&
                          landing.latency_mean() >= least;
  if (!is_shifted) return {};
  return fmt::format(
      "{:<12} all landings are found {:.0f} ms late: is the clock of the truth, or that of the "
      "signals, shifted?\n",
      "", 1e3 * landing.latency_mean());
}

/// "none": of the steps that count, none has the class.
std::string share(double value) {
  return std::isnan(value) ? "none" : fmt::format("{:.4f}", value);
}

/// What estimators are ranked by.
std::string ranking_text(const scoring::Score& score) {
  const auto median = [](const scoring::Latencies& latencies, const char* name) {
    const double ms = latencies.median();
    return std::isnan(ms) ? "" : fmt::format(", {} {:+.1f} ms", name, ms);
  };
  return fmt::format(
      "{:<12} F1 of takeoffs and landings {}, extra switches {:.1f}/min, long errors {:.2f} "
      "s/min{}{}, precision of air {}, balanced accuracy {}\n",
      "truth", share(score.events.f1()), score.extra_switches_per_minute(),
      score.long_errors_s_per_minute(), median(score.events.takeoff, "median takeoff"),
      median(score.events.landing, "landing"), share(score.points.no_contact_precision()),
      share(score.points.balanced_accuracy()));
}

std::string score_text(const scoring::Score& score, std::int64_t takeoffs, std::int64_t landings) {
  const scoring::Classification& points = score.points;
  return ranking_text(score) +
         fmt::format(
             "{:<12} accuracy {}, precision of contact {}, recall of contact {}, of no contact {}, "
             "Brier {}\n{:<12} {}; {}\n",
             "", share(points.success()), share(points.contact_precision()),
             share(points.contact_recall()), share(points.no_contact_recall()),
             share(score.calibration.brier()), "", found(score.takeoff, takeoffs, "takeoffs"),
             found(score.landing, landings, "landings")) +
         shift_text(score.landing);
}

/// The log's own clock (ns).
std::int64_t stamp_of(double time, double start) {
  return std::llround(1e9 * start) + std::llround(1e9 * time);
}

/// Appends a number to a message in CDR: aligned to its size after the four bytes in front.
template <typename T>
void put(std::string& message, T number) {
  constexpr std::size_t front = 4;
  message.append((sizeof number - (message.size() - front) % sizeof number) % sizeof number, '\0');
  message.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void put(std::string& message, std::string_view text) {
  put(message, static_cast<std::uint32_t>(text.size() + 1));
  message.append(text).push_back('\0');
}

void put(std::string& message, const std::array<double, 2>& numbers) {
  put(message, static_cast<std::uint32_t>(numbers.size()));
  for (const double number : numbers) put(message, number);
}

}  // namespace

BeliefCsv::BeliefCsv(std::ostream& stream) : stream_(stream) {
  fmt::format_to(std::back_inserter(buffer_),
                 "time_s,p_contact_left,p_contact_right,contact_left,contact_right,p_any_wheel,"
                 "p_both_wheels,p_takeoff,p_landing,status,load_left_n,load_right_n,"
                 "load_deviation_left_n,load_deviation_right_n,stamp_ns\n");
}

void BeliefCsv::write(double time, double start, const Belief& belief, const Evidence& evidence) {
  const auto& [left, right] = belief.wheel;
  fmt::format_to(std::back_inserter(buffer_),
                 FMT_COMPILE("{},{},{},{:d},{:d},{},{},{},{},{},{},{},{},{},{}\n"), time,
                 left.p_contact, right.p_contact, left.contact, right.contact, belief.p_any_wheel,
                 belief.p_both_wheels, evidence.transition.p_takeoff, evidence.transition.p_landing,
                 to_text(belief.status), left.load.force, right.load.force, left.load.deviation,
                 right.load.deviation, stamp_of(time, start));
  constexpr std::size_t large = std::size_t{1} << 16U;
  if (buffer_.size() >= large) flush();
}

void BeliefCsv::flush() {
  stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  stream_.flush();
  buffer_.clear();
  if (!stream_) throw Error("the beliefs cannot be written: is the disk full?");
}

BeliefBag::BeliefBag(std::ostream& stream)
    : writer_(stream, "ros2"),
      topic_(writer_.add_topic("/touchdown/contact", logs::joint_state_type,
                               logs::joint_state_definition, {"ros2msg", "cdr"})) {}

void BeliefBag::write(double time, double start, const Belief& belief) {
  constexpr std::int64_t second = 1'000'000'000;
  const std::int64_t stamp = stamp_of(time, start);
  const auto& [left, right] = belief.wheel;
  message_.assign("\0\1\0\0", 4);  // CDR, little-endian
  put(message_, static_cast<std::int32_t>(stamp / second));
  put(message_, static_cast<std::uint32_t>(stamp % second));
  put(message_, std::string_view());
  put(message_, std::uint32_t{2});
  put(message_, std::string_view("left_wheel"));
  put(message_, std::string_view("right_wheel"));
  put(message_, {left.p_contact, right.p_contact});
  put(message_, {left.contact ? 1.0 : 0.0, right.contact ? 1.0 : 0.0});
  put(message_, {left.load.force, right.load.force});
  writer_.write(topic_, static_cast<std::uint64_t>(std::max<std::int64_t>(stamp, 0)), message_);
}

LogScore::LogScore(std::int64_t period_us, const scoring::LabelConfig& labels, double robot_mass,
                   const scoring::ScoringConfig& scoring, bool segment_counts)
    : period_us_(period_us),
      labels_(labels),
      robot_mass_(robot_mass),
      scoring_(scoring),
      segment_counts_(segment_counts) {}

void LogScore::add(const LogStep& step, const Belief& belief) {
  const double time = 1e-6 * static_cast<double>(period_us_ * steps_++);
  if (!step.normal_force) {
    is_scored_ = is_scored_ && segment_counts_;
    end_segment();
    return;
  }
  for (std::size_t w = 0; w < belief.wheel.size() && time >= scoring_.skip; ++w) {
    // Labels of contact stand for an unknown force.
    if (std::isfinite((*step.normal_force)[w])) {
      load_.add((*step.normal_force)[w], belief.wheel[w].load);
    }
  }
  if (!is_scored_) return;
  if (!duration_) {
    scoring::ScoringConfig scoring = scoring_;
    scoring.skip = std::max(0.0, scoring_.skip - time);
    duration_.emplace(period_us_, labels_, robot_mass_, scoring);
  }
  duration_->add(*step.normal_force, belief);
}

std::optional<scoring::RobotScore> LogScore::finish() {
  end_segment();
  return is_scored_ ? total_ : std::nullopt;
}

std::string LogScore::load_text() const {
  if (load_.known() == 0) return {};
  return fmt::format("{:<12} median error {:.2f} N, {} within 2 σ, known at {} of steps\n", "load",
                     load_.median_error(), percent(load_.covered, load_.known()),
                     percent(load_.known(), load_.steps));
}

void LogScore::end_segment() {
  if (!duration_) return;
  if (!total_) total_.emplace();
  *total_ += duration_->finish();
  duration_.reset();
}

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
    // Jitter, and stamps rounded to a tick, are no lost records.
    constexpr double least = 2.5;  // periods
    if (time - previous > least * period) {
      lost += time - previous - period;
      ++gaps;
    }
    if (time < previous) ++steps_back;
    if (time == previous) ++repeated;
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
  if (gaps > 1) text += fmt::format(" in {} gaps", gaps);
  if (steps_back > 0) {
    text += fmt::format("; it goes back {} time{}", steps_back, steps_back == 1 ? "" : "s");
  }
  if (repeated > 0) text += fmt::format("; {} steps repeat the time before", repeated);
  return text;
}

void LogSummary::WheelEvents::interrupt() {
  raw_.reset();
  lasting_.reset();
}

void LogSummary::WheelEvents::add(double time, bool contact) {
  if (raw_ != contact) {
    switches += raw_ ? 1 : 0;
    raw_ = contact;
    held_ = 0;
    since_ = time;
  }
  if (++held_ < shortest_ || lasting_ == contact) return;
  if (lasting_) (contact ? landings : takeoffs).add(since_);
  lasting_ = contact;
}

LogSummary::LogSummary(double period, const scoring::ScoringConfig& scoring)
    : clock_{period, NAN, NAN, NAN},
      skipped_(std::llround(scoring.skip / period)),
      longest_bridged_(std::llround(SignalGuardConfig{}.maximum_gap / period)),
      wheels_{WheelEvents(std::llround(scoring.minimum_flight / period)),
              WheelEvents(std::llround(scoring.minimum_flight / period))} {}

double LogSummary::duration() const {
  return std::isnan(clock_.previous) ? 0.0 : clock_.last - clock_.first + clock_.period;
}

void LogSummary::add(double time, const Belief& belief) {
  clock_.add(time);
  if (belief.status == SignalStatus::invalid && belief.unusable != SignalIndex::none) {
    ++unusable_[static_cast<std::size_t>(belief.unusable)];
  }
  ++status_[static_cast<std::size_t>(belief.status)];
  if (steps_ == 0) first_is_degraded_ = belief.status == SignalStatus::degraded;
  if (steps_++ < skipped_) return;
  if (is_used(belief.status)) {
    add_valid(time, belief);
    invalid_in_a_row_ = 0;
  } else if (++invalid_in_a_row_ == longest_bridged_ + 1) {
    for (WheelEvents& wheel : wheels_) wheel.interrupt();
  }
}

void LogSummary::add_valid(double time, const Belief& belief) {
  ++counted_;
  const auto views = scoring::views_of(belief);
  for (std::size_t v = 0; v < scoring::view_count; ++v) contact_[v] += views[v].contact ? 1 : 0;
  for (std::size_t w = 0; w < wheels_.size(); ++w) wheels_[w].add(time, belief.wheel[w].contact);
}

std::string LogSummary::contact_text() const {
  if (counted_ == 0) return steps_ > skipped_ ? "no valid step" : "too short to count";
  std::string text = fmt::format("left {}, right {}, any wheel {}, both {}",
                                 percent(contact_[0], counted_), percent(contact_[1], counted_),
                                 percent(contact_[2], counted_), percent(contact_[3], counted_));
  if (valid_steps() < steps_) text += fmt::format(" of {} valid steps", counted_);
  return text +
         fmt::format(", after the first {:g} s", static_cast<double>(skipped_) * clock_.period);
}

std::string LogSummary::events_text(std::size_t w) const {
  const WheelEvents& wheel = wheels_[w];
  std::string text = "no takeoff, no landing";
  const std::int64_t events = wheel.takeoffs.count + wheel.landings.count;
  if (events > 0) {
    text = fmt::format("takeoffs at (s) {}; landings at (s) {}", wheel.takeoffs.text(),
                       wheel.landings.text());
  }
  if (wheel.switches > events) {
    text += fmt::format("; {} raw switches", wheel.switches);
  }
  return text;
}

std::string LogSummary::signals_text(std::size_t findings) const {
  std::vector<std::string> parts;
  if (valid_steps() < steps_) parts.push_back(invalid_text());
  const auto most = std::max_element(unusable_.begin(), unusable_.end());
  if (*most > 0) {
    const auto signal = static_cast<SignalIndex>(most - unusable_.begin());
    const auto kinds = std::count_if(unusable_.begin(), unusable_.end(),
                                     [](std::int64_t steps) { return steps > 0; });
    parts.push_back(fmt::format("unusable: {}{}", to_text(signal),
                                kinds == 1 ? "" : fmt::format(" and {} others", kinds - 1)));
  }
  if (findings > 0) {
    parts.push_back(fmt::format("not plausible: {} finding{}, printed above", findings,
                                findings == 1 ? "" : "s"));
  }
  if (parts.empty()) parts.emplace_back(counted_ > 0 ? "all good" : "too few to judge");
  const std::int64_t degraded = status_[static_cast<std::size_t>(SignalStatus::degraded)];
  if (degraded > 0 && degraded == steps_) {
    parts.emplace_back("no targets of joints");
  } else if (degraded > (first_is_degraded_ ? 1 : 0)) {
    parts.push_back(fmt::format("no targets of joints at {} of {} steps", degraded, steps_));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

/// "3 invalid, 1 gap of 700 steps".
std::string LogSummary::invalid_text() const {
  std::vector<std::string> parts;
  for (const SignalStatus status :
       {SignalStatus::invalid, SignalStatus::gap, SignalStatus::frozen}) {
    const std::int64_t count = status_[static_cast<std::size_t>(status)];
    if (count > 0) parts.push_back(fmt::format("{} {}", count, to_text(status)));
  }
  return fmt::format("{} of {} steps", fmt::join(parts, ", "), steps_);
}

std::string LogSummary::text(const std::optional<scoring::RobotScore>& score, double start,
                             std::size_t findings) {
  std::string text =
      fmt::format("{:<12} {}\n{:<12} {}\n{:<12} {}\n{:<12} {}\n{:<12} {}\n", "time",
                  clock_.text(start), "contact", contact_text(), "left wheel", events_text(0),
                  "right wheel", events_text(1), "signals", signals_text(findings));
  if (score && score->wheels().points.points() == 0) {
    text += fmt::format(
        "{:<12} not scored: beliefs of the first {:g} s depend on the prior, and nothing follows\n",
        "truth", static_cast<double>(skipped_) * clock_.period);
  } else if (score) {
    text += score_text(score->wheels(), wheels_[0].takeoffs.count + wheels_[1].takeoffs.count,
                       wheels_[0].landings.count + wheels_[1].landings.count);
  }
  return text;
}

}  // namespace touchdown::experiments
