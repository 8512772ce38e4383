#include "experiments/logs/log_steps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/table.hpp"
#include "logs/sample_times.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

namespace {

/// The rate of the log (Hz). A simulated log specifies its own.
double usable_rate(logs::LogReader& reader) {
  const logs::RecordingInfo& info = reader.info();
  const double measured = 1e6 / static_cast<double>(info.control_period_us);
  const double rate = info.simulator.empty() ? logs::nominal_rate(measured) : measured;
  constexpr double lowest = 100.0;
  constexpr double highest = 20'000.0;
  if (!(rate >= lowest && rate <= highest)) {
    throw InputError(
        fmt::format("{}: {} steps per second: expected 100 to 20000, since estimators bridge "
                    "gaps of 20 ms",
                    reader.name(), readable(rate, 4)));
  }
  return rate;
}

}  // namespace

/// Compares labels of contact with the load on each wheel that the torques of its leg give, so that
/// labels of another log or clock, or exchanged ones, do not become a model. Only the order of
/// loads counts, because the legs of a robot that is not known are taken for Upkie's.
class LogSteps::LabelCheck {
 public:
  LabelCheck(const logs::ContactIntervals& labels, double sample_rate, const LegGeometry& legs)
      : labels_(labels), model_(legs, sample_rate) {}

  /// Returns the loads.
  DynamicLoads::Loads add(const Signals& signals) {
    const DynamicLoads::Loads loads = model_.update(signals);
    if (!std::isfinite(signals.time)) return loads;
    last_ = std::max(last_, signals.time);
    if (!(signals.time >= next_) || !std::isfinite(loads[0].force + loads[1].force)) return loads;
    next_ = signals.time + interval_;
    for (std::size_t side = 0; side < models::wheel_count; ++side) {
      samples_.push_back({loads[side].force, signals.time, side});
    }
    constexpr std::size_t most = std::size_t{1} << 15U;
    if (samples_.size() < most) return loads;
    interval_ *= 2.0;  // a long log needs fewer
    std::size_t i = 0;
    std::erase_if(samples_, [&](const Sample& /*of a pair*/) { return i++ % 4 >= 2; });
    return loads;
  }

  std::optional<std::string> finding() const {
    std::vector<Sample> ordered = samples_;
    std::ranges::sort(ordered, {}, &Sample::load);
    const std::optional<double> agreement = agreement_of(ordered, 0.0);
    constexpr double certain = 0.95;
    if (!agreement || *agreement >= certain) return std::nullopt;
    double best = *agreement;
    double shift = 0.0;
    constexpr int most_steps = 250;
    constexpr double step = 0.02;    // s
    constexpr double better = 0.01;  // of a repeated motion the nearest one counts
    for (int i = 1; i <= most_steps; ++i) {
      for (const double by : {step * i, -step * i}) {
        const std::optional<double> shifted = agreement_of(ordered, by);
        const double least_best = std::abs(by - shift) < 2.0 * step ? best : best + better;
        if (!shifted || *shifted <= least_best) continue;
        best = *shifted;
        shift = by;
      }
    }
    constexpr double usual = 0.7;
    constexpr double good = 0.85;
    constexpr double clearly = 0.1;
    if (*agreement >= usual && best - *agreement < clearly) return std::nullopt;
    std::string cause = "are they those of another log, or is the robot another (--robot)?";
    if (*agreement < 1.0 - usual && 1.0 - *agreement >= best) {
      cause = "are 1, contact, and 0 exchanged?";
    } else if (best >= good && best - *agreement >= clearly) {
      cause = fmt::format("{:.0f} % if they come {:.1f} s {}: is the zero of their time another?",
                          100.0 * best, std::abs(shift), shift > 0.0 ? "earlier" : "later");
    }
    return fmt::format(
        "{}: the torques give a wheel more load in contact than without at {:.0f} % of pairs of "
        "moments, expected 90 and more: {}",
        labels_.file, 100.0 * *agreement, cause);
  }

  void require_within(const std::string& log, std::int64_t labelled) const {
    if (labels_.intervals.empty()) return;
    const double end = labels_.intervals.back().end;
    if (labelled == 0) {
      throw InputError(fmt::format(
          "{}: none of its intervals, from {:.3f} to {:.3f} s, covers a step of {}, which ends at "
          "{:.3f} s: expected times as `touchdown estimate` prints them",
          labels_.file, labels_.intervals.front().start, end, log, last_));
    }
    constexpr double tolerance = 1.0;  // s
    if (!std::isfinite(last_) || end <= 1.1 * last_ + tolerance) return;
    throw InputError(
        fmt::format("{}: its last interval ends at {:.3f} s, and {} at {:.3f} s: expected seconds, "
                    "as `touchdown estimate` prints them; are they another unit, or another log's?",
                    labels_.file, end, log, last_));
  }

 private:
  struct Sample {
    double load;  ///< N
    double time;  ///< s
    std::size_t wheel;
  };

  /// The share of pairs, one sample in contact and one without, of which the first has more load,
  /// if the labels were `shift` seconds earlier. Intervals that are not longer than the low-pass of
  /// the load and the beginnings of the others do not count. Nothing for labels of one class alone.
  std::optional<double> agreement_of(const std::vector<Sample>& ordered, double shift) const {
    constexpr double least = 0.06;     // s
    constexpr double settling = 0.03;  // s
    std::array<std::int64_t, 2> samples{};
    std::int64_t right = 0;
    for (const Sample& sample : ordered) {
      const double time = sample.time + shift;
      const logs::ContactInterval* const label = labels_.at(time);
      if (label == nullptr || label->end - label->start < least) continue;
      if (time - label->start < settling) continue;
      const bool contact = label->contact.at(sample.wheel);
      ++samples.at(contact ? 1 : 0);
      if (contact) right += samples[0];
    }
    constexpr std::int64_t few = 25;
    if (std::min(samples[0], samples[1]) < few) return std::nullopt;
    return static_cast<double>(right) / static_cast<double>(samples[0] * samples[1]);
  }

  const logs::ContactIntervals& labels_;
  DynamicLoads model_;
  std::vector<Sample> samples_;
  double interval_ = 0.01;  ///< between samples (s)
  double next_ = -std::numeric_limits<double>::infinity();
  double last_ = -std::numeric_limits<double>::infinity();
};

LogSteps::LogSteps(logs::LogReader& reader, const logs::ContactIntervals* labels,
                   const LogRobot& robot)
    : reader_(reader),
      labels_(labels),
      robot_(checked_robot(robot, reader.info())),
      sample_rate_(usable_rate(reader)),
      info_(reader.info()),
      robot_mass_(robot.legs ? robot.legs->robot_mass : scoring::robot_mass(info_)),
      signals_(sample_rate_),
      plausibility_(1.0 / sample_rate_, robot_, reader.start_time(), reader.quaternion_reading()) {
  info_.control_period_us = std::llround(1e6 / sample_rate_);
  if (!robot_.doubt.empty())
    reader.notes().warnings.push_back(fmt::format("{}: {}", reader.name(), robot_.doubt));
  if (labels == nullptr) return;
  const LegGeometry legs = robot_.legs.value_or(LegGeometry{});
  label_check_ = std::make_unique<LabelCheck>(*labels, sample_rate_, legs);
}

LogSteps::~LogSteps() = default;

const LogStep* LogSteps::next() {
  const std::optional<logs::LogRow> row = reader_.next();
  if (!row) return nullptr;
  ++steps_;
  step_.signals = signals_.next(row->observation, row->action);
  plausibility_.add(row->observation, step_.signals.target);
  add_to_digest(step_.signals);
  if (label_check_) step_.loads = label_check_->add(step_.signals);
  step_.truth.reset();
  if (row->truth) {
    const auto& force = row->truth->wheel_normal_force;
    if (!std::isnan(force[0]) && !std::isnan(force[1])) step_.truth = force;
  }
  step_.normal_force = step_.truth;
  if (labels_ == nullptr) return &step_;
  step_.normal_force.reset();
  if (const logs::ContactInterval* label = labels_->at(row->observation.time)) {
    ++labelled_;
    constexpr double some_force = std::numeric_limits<double>::infinity();
    step_.normal_force = {label->contact[0] ? some_force : 0.0,
                          label->contact[1] ? some_force : 0.0};
  }
  return &step_;
}

void LogSteps::add_to_digest(const Signals& signals) {
  const auto add = [this](double number) {
    constexpr std::uint64_t prime = 0x9e3779b97f4a7c15;
    digest_ = std::rotl((digest_ ^ std::bit_cast<std::uint64_t>(number)) * prime, 29);
  };
  add(signals.vertical_acceleration);
  for (const LegSignals& leg : signals.leg) {
    for (const JointSignals& joint : {leg.hip, leg.knee, leg.wheel}) add(joint.torque);
  }
}

std::string LogSteps::digest() const { return fmt::format("{:016x}", digest_); }

std::vector<std::string> LogSteps::findings() const {
  std::vector<std::string> findings = reader_.notes().findings;
  std::ranges::move(plausibility_.findings(), std::back_inserter(findings));
  if (!label_check_) return findings;
  if (std::optional<std::string> label = label_check_->finding()) findings.push_back(*label);
  return findings;
}

void LogSteps::require_labels_within() const {
  if (label_check_) label_check_->require_within(reader_.name(), labelled_);
}

}  // namespace touchdown::experiments
