#include "experiments/logs/summary.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/compile.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/table.hpp"
#include "estimator/signal_guard.hpp"
#include "experiments/results/captions.hpp"
#include "logs/bags/topic_rows.hpp"

namespace touchdown::experiments {

namespace {

std::string line(std::string_view name, std::string_view words) {
  return fmt::format("{:<12} {}\n", name, words);
}

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
    text += fmt::format(", {} of those that are found before a state under {:g} ms and not listed",
                        -others, 1e3 * scoring::ScoringConfig{}.minimum_flight);
  }
  return text;
}

/// "none": of the steps that count, none has the class.
std::string share(double value) {
  return std::isnan(value) ? "none" : fmt::format("{:.4f}", value);
}

/// First what estimators are ranked by.
std::string score_text(const scoring::Score& score, std::int64_t takeoffs, std::int64_t landings) {
  const scoring::Classification& points = score.points;
  const auto median = [](const scoring::Latencies& latencies, const char* name) {
    const double ms = latencies.median();
    return std::isnan(ms) ? "" : fmt::format(", {} {:+.1f} ms", name, ms);
  };
  // Labels may leave the moments of transition unknown.
  const std::string f1 = score.events.truth == 0 && score.events.decided > 0
                             ? "none (the truth has no takeoff or landing between known steps)"
                             : share(score.events.f1());
  std::string text =
      line("truth",
           fmt::format("F1 of takeoffs and landings {}, extra switches {:.1f}/min, long errors "
                       "{:.2f} s/min{}{}, precision of air {}, balanced accuracy {}",
                       f1, score.extra_switches_per_minute(), score.long_errors_s_per_minute(),
                       median(score.events.takeoff, "median takeoff"),
                       median(score.events.landing, "landing"),
                       share(points.no_contact_precision()), share(points.balanced_accuracy()))) +
      line("", fmt::format("accuracy {}, precision of contact {}, recall of contact {}, of no "
                           "contact {}, Brier {}",
                           share(points.success()), share(points.contact_precision()),
                           share(points.contact_recall()), share(points.no_contact_recall()),
                           share(score.calibration.brier()))) +
      line("", fmt::format("{}; {}", found(score.takeoff, takeoffs, "takeoffs"),
                           found(score.landing, landings, "landings")));
  // Landings that are all found late by the same time: an impact shows at once.
  const scoring::TransitionCounts& landing = score.landing;
  constexpr std::int64_t few = 3;
  constexpr double least = 0.03;  // s
  constexpr double alike = 0.005;
  if (landing.detected < few || !(landing.latency_deviation() < alike) ||
      !(landing.latency_mean() >= least)) {
    return text;
  }
  return text + line("", fmt::format("all landings are found {:.0f} ms late: is the clock of the "
                                     "truth, or that of the signals, shifted?",
                                     1e3 * landing.latency_mean()));
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

void write_csv(std::ostream& stream, double time, std::int64_t stamp, const Belief& belief,
               const Evidence& evidence) {
  const auto& [left, right] = belief.wheel;
  fmt::memory_buffer line;
  fmt::format_to(std::back_inserter(line),
                 FMT_COMPILE("{},{},{},{:d},{:d},{},{},{},{},{},{},{},{},{},{}\n"), time,
                 left.p_contact, right.p_contact, left.contact, right.contact, belief.p_any_wheel,
                 belief.p_both_wheels, evidence.transition.p_takeoff, evidence.transition.p_landing,
                 to_text(belief.status), left.load.force, right.load.force, left.load.deviation,
                 right.load.deviation, stamp);
  stream.write(line.data(), static_cast<std::streamsize>(line.size()));
}

BeliefBag::BeliefBag(std::ostream& stream)
    : writer_(stream, "ros2"),
      topic_(writer_.add_topic("/touchdown/contact", logs::joint_state_type,
                               logs::joint_state_definition, {"ros2msg", "cdr"})) {}

void BeliefBag::write(std::int64_t stamp, const Belief& belief) {
  constexpr std::int64_t second = 1'000'000'000;
  const auto& [left, right] = belief.wheel;
  std::string message("\0\1\0\0", 4);  // CDR, little-endian
  put(message, static_cast<std::int32_t>(stamp / second));
  put(message, static_cast<std::uint32_t>(stamp % second));
  put(message, std::string_view());
  put(message, std::uint32_t{2});
  put(message, std::string_view("left_wheel"));
  put(message, std::string_view("right_wheel"));
  put(message, {left.p_contact, right.p_contact});
  put(message, {left.contact ? 1.0 : 0.0, right.contact ? 1.0 : 0.0});
  put(message, {left.load.force, right.load.force});
  writer_.write(topic_, static_cast<std::uint64_t>(std::max<std::int64_t>(stamp, 0)), message);
}

LogScore::LogScore(std::int64_t period_us, const scoring::LabelConfig& labels, double robot_mass,
                   const scoring::ScoringConfig& scoring, bool segment_counts)
    : period_us_(period_us),
      labels_(labels),
      robot_mass_(robot_mass),
      scoring_(scoring),
      segment_counts_(segment_counts) {}

void LogScore::add(const std::optional<std::array<double, models::wheel_count>>& normal_force,
                   const std::optional<std::array<double, models::wheel_count>>& truth,
                   const Belief& belief) {
  const double time = 1e-6 * static_cast<double>(period_us_ * steps_++);
  const auto& force = truth ? truth : normal_force;
  for (std::size_t w = 0; force && w < belief.wheel.size() && time >= scoring_.skip; ++w) {
    // Labels of contact stand for an unknown force.
    if (std::isfinite((*force)[w])) {
      load_.add((*force)[w], belief.wheel[w].load);
    } else {
      is_load_of_air_ = true;
    }
  }
  if (!normal_force) {
    is_scored_ = is_scored_ && segment_counts_;
    end_segment();
    return;
  }
  if (!is_scored_) return;
  if (force_[0].empty()) start_ = time;
  for (std::size_t w = 0; w < force_.size(); ++w) force_[w].push_back((*normal_force)[w]);
  add_step(segment_, belief);
}

std::optional<scoring::RobotScore> LogScore::finish() {
  end_segment();
  return is_scored_ ? total_ : std::nullopt;
}

std::string LogScore::load_text() const {
  if (load_.known() == 0) return {};
  return line("load", fmt::format("{}median error {:.2f} N, {} within 2 σ, known at {} of steps",
                                  is_load_of_air_ ? "where labels state no contact: " : "",
                                  load_.median_error(), percent(load_.covered, load_.known()),
                                  percent(load_.known(), load_.steps)));
}

void LogScore::end_segment() {
  if (force_[0].empty()) return;
  std::array<scoring::ContactSequence, models::wheel_count> truth;
  for (std::size_t w = 0; w < truth.size(); ++w) {
    truth[w] =
        contact_labels(force_[w], 1e-6 * static_cast<double>(period_us_), robot_mass_, labels_);
    force_[w].clear();
  }
  scoring::ScoringConfig scoring = scoring_;
  scoring.skip = std::max(0.0, scoring_.skip - start_);
  if (!total_) total_.emplace();
  *total_ += score(truth, std::exchange(segment_, {}), {0}, period_us_, scoring).front();
}

LogSummary::LogSummary(double period, const scoring::ScoringConfig& scoring)
    : period_(period),
      skipped_(std::llround(scoring.skip / period)),
      longest_bridged_(std::llround(SignalGuardConfig{}.maximum_gap / period)),
      shortest_(std::llround(scoring.minimum_flight / period)) {}

void LogSummary::add(double time, const Belief& belief) {
  add_time(time);
  ++status_[static_cast<std::size_t>(belief.status)];
  if (belief.status == SignalStatus::invalid && belief.unusable != SignalIndex::none) {
    ++unusable_[static_cast<std::size_t>(belief.unusable)];
  }
  if (steps_ == 0) first_is_degraded_ = belief.status == SignalStatus::degraded;
  if (steps_++ < skipped_) return;
  if (!is_used(belief.status)) {
    if (++invalid_in_a_row_ != longest_bridged_ + 1) return;
    for (Wheel& wheel : wheels_) wheel.raw = wheel.lasting = std::nullopt;
    return;
  }
  invalid_in_a_row_ = 0;
  ++counted_;
  const auto views = scoring::views_of(belief);
  for (std::size_t v = 0; v < views.size(); ++v) contact_[v] += views[v].contact ? 1 : 0;
  for (std::size_t w = 0; w < wheels_.size(); ++w) {
    add_decision(time, belief.wheel[w].contact, wheels_[w]);
  }
}

void LogSummary::add_time(double time) {
  if (!std::isfinite(time)) return;
  // Jitter, and stamps rounded to a tick, are no lost records.
  constexpr double least = 2.5;  // periods
  if (time - previous_ > least * period_) {
    lost_ += time - previous_ - period_;
    ++gaps_;
  }
  if (time < previous_) ++steps_back_;
  if (time == previous_) ++repeated_;
  first_ = std::fmin(first_, time);
  last_ = std::fmax(last_, time);
  previous_ = time;
}

void LogSummary::add_decision(double time, bool contact, Wheel& wheel) const {
  if (wheel.raw != contact) {
    wheel.switches += wheel.raw ? 1 : 0;
    wheel.raw = contact;
    wheel.held = 0;
    wheel.since = time;
  }
  if (++wheel.held < shortest_ || wheel.lasting == contact) return;
  if (wheel.lasting) {
    const std::size_t kind = contact ? 1 : 0;
    ++wheel.events.at(kind);
    constexpr std::size_t most_listed = 8;
    std::vector<double>& times = wheel.first.at(kind);
    if (times.size() < most_listed) times.push_back(wheel.since);
  }
  wheel.lasting = contact;
}

std::string LogSummary::time_text(double start) const {
  if (std::isnan(first_)) return "no finite value";
  std::string text = fmt::format("from {} to {} s", fixed(first_, 3), fixed(last_, 3));
  if (start != 0.0) text += fmt::format(", 0 being {} s of the log's clock", fixed(start, 3));
  if (lost_ > 0.0) text += fmt::format("; {} s without records", fixed(lost_, 3));
  if (gaps_ > 1) text += fmt::format(" in {} gaps", gaps_);
  if (steps_back_ > 0)
    text += fmt::format("; it goes back {}", plural(static_cast<std::size_t>(steps_back_), "time"));
  if (repeated_ > 0) text += fmt::format("; {} steps repeat the time before", repeated_);
  return text;
}

std::string LogSummary::contact_text() const {
  if (counted_ == 0) return steps_ > skipped_ ? "no valid step" : "too short to count";
  std::string text = fmt::format("left {}, right {}, any wheel {}, both {}",
                                 percent(contact_[0], counted_), percent(contact_[1], counted_),
                                 percent(contact_[2], counted_), percent(contact_[3], counted_));
  if (valid_steps() < steps_) text += fmt::format(" of {} valid steps", counted_);
  return text + fmt::format(", after the first {:g} s", static_cast<double>(skipped_) * period_);
}

std::string LogSummary::signals_text(std::size_t findings) const {
  std::vector<std::string> parts;
  if (valid_steps() < steps_) {
    for (const SignalStatus status :
         {SignalStatus::invalid, SignalStatus::gap, SignalStatus::frozen}) {
      const std::int64_t count = steps_with(status);
      if (count > 0) parts.push_back(fmt::format("{} {}", count, to_text(status)));
    }
    parts = {fmt::format("{} of {} steps", fmt::join(parts, ", "), steps_)};
  }
  const auto most = std::ranges::max_element(unusable_);
  if (*most > 0) {
    const auto kinds = std::ranges::count_if(unusable_, [](auto steps) { return steps > 0; });
    parts.push_back(fmt::format("unusable: {}{}",
                                to_text(static_cast<SignalIndex>(most - unusable_.begin())),
                                kinds == 1 ? "" : fmt::format(" and {} others", kinds - 1)));
  }
  if (findings > 0) {
    parts.push_back(fmt::format("not plausible: {}, printed above", plural(findings, "finding")));
  }
  if (parts.empty()) parts.emplace_back(counted_ > 0 ? "all good" : "too few to judge");
  const std::int64_t degraded = steps_with(SignalStatus::degraded);
  if (degraded > 0 && degraded == steps_) {
    parts.emplace_back("no targets of joints");
  } else if (degraded > (first_is_degraded_ ? 1 : 0)) {
    parts.push_back(fmt::format("no targets of joints at {} of {} steps", degraded, steps_));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string LogSummary::text(const std::optional<scoring::RobotScore>& score, double start,
                             std::size_t findings) const {
  const auto& [left, right] = wheels_;
  const auto listed = [&](const Wheel& wheel, std::size_t kind) {
    const std::vector<double>& times = wheel.first.at(kind);
    const auto count = static_cast<std::size_t>(wheel.events.at(kind));
    return times.empty()
               ? "none"
               : fmt::format("{:.3f}{}", fmt::join(times, ", "),
                             count > times.size() ? fmt::format(" … ({} in all)", count) : "");
  };
  const auto events = [&](const Wheel& wheel) {
    const std::int64_t count = wheel.events[0] + wheel.events[1];
    return (count == 0 ? "no takeoff, no landing"
                       : fmt::format("takeoffs at (s) {}; landings at (s) {}", listed(wheel, 0),
                                     listed(wheel, 1))) +
           (wheel.switches > count ? fmt::format("; {} raw switches", wheel.switches) : "");
  };
  std::string text = line("time", time_text(start)) + line("contact", contact_text()) +
                     line("left wheel", events(left)) + line("right wheel", events(right)) +
                     line("signals", signals_text(findings));
  if (score && score->wheels().points.points() == 0) {
    return text + line("truth", fmt::format("not scored: beliefs of the first {:g} s depend on the "
                                            "prior, and nothing follows",
                                            static_cast<double>(skipped_) * period_));
  }
  if (score) {
    text += score_text(score->wheels(), left.events[0] + right.events[0],
                       left.events[1] + right.events[1]);
  }
  return text;
}

}  // namespace touchdown::experiments
