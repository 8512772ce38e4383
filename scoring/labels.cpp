#include "scoring/labels.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "estimator/force/leg_geometry.hpp"

namespace touchdown::scoring {

namespace {

ContactSequence combined(const std::array<ContactSequence, models::wheel_count>& wheels,
                         const std::function<bool(bool, bool)>& rule) {
  ContactSequence result(wheels[0].size());
  std::transform(wheels[0].begin(), wheels[0].end(), wheels[1].begin(), result.begin(),
                 [&](auto left, auto right) { return std::uint8_t{rule(left != 0, right != 0)}; });
  return result;
}

}  // namespace

void describe(Fields& fields, Annotator& annotator) {
  fields("frame", annotator.frame, 0.0, 1.0)
      .doc("s", "Time between the film's frames; 0: the annotator sees every step.");
  fields("takeoff_delay", annotator.takeoff_delay, -1.0, 1.0)
      .doc("s", "Marked minus true time of takeoffs; negative: early.");
  fields("landing_delay", annotator.landing_delay, -1.0, 1.0)
      .doc("s", "Marked minus true time of landings; negative: early.");
}

void describe(Fields& fields, LabelConfig& labels) {
  for (const char* former : {"force_threshold", "debounce"}) {
    fields.gone(former,
                "expected 'share' of the weight and 'window' of the mean force, which replace it");
  }
  fields("share", labels.share, 0.0, 1.0)
      .doc("A wheel is in contact above this share of the robot's weight.");
  fields("window", labels.window, 0.0, 1.0)
      .doc("s", "The normal force is averaged over this time around each step.");
  fields.section("annotator", labels.annotator)
      .doc("Timing errors of a person who labels contact in a film.");
}

double force_threshold(const LabelConfig& config, double robot_mass) {
  constexpr double gravity = 9.81;
  return config.share * robot_mass * gravity;
}

double robot_mass(const logs::RecordingInfo& info) {
  return info.robot_mass > 0.0 ? info.robot_mass : LegGeometry{}.robot_mass;
}

ContactSequence annotated(const ContactSequence& contact, double period,
                          const Annotator& annotator) {
  const auto end = static_cast<std::ptrdiff_t>(contact.size());
  const auto marked = [&](std::size_t event, double delay) {
    const auto step = static_cast<std::ptrdiff_t>(event);
    if (step == 0 || step == end) return step;
    return std::clamp(step + std::ptrdiff_t{std::llround(delay / period)}, std::ptrdiff_t{0}, end);
  };
  ContactSequence marked_contact(contact.size(), 1);
  for (const Flight& flight : flights(contact)) {
    const std::ptrdiff_t takeoff = marked(flight.takeoff, annotator.takeoff_delay);
    const std::ptrdiff_t landing = marked(flight.landing, annotator.landing_delay);
    if (takeoff < landing)
      std::fill(marked_contact.begin() + takeoff, marked_contact.begin() + landing, 0);
  }
  if (!(annotator.frame > 0.0)) return marked_contact;
  ContactSequence result(marked_contact.size());
  for (std::size_t k = 0; k < marked_contact.size(); ++k) {
    // The tolerance includes a frame that is taken at this very step, despite rounding of the time.
    const double frame_time =
        std::floor(static_cast<double>(k) * period / annotator.frame + 1e-9) * annotator.frame;
    result[k] = marked_contact[static_cast<std::size_t>(std::llround(frame_time / period))];
  }
  return result;
}

ContactSequence contact_labels(std::span<const double> normal_force, double period,
                               double robot_mass, const LabelConfig& config) {
  ContactSequence contact;
  contact.reserve(normal_force.size());
  LabelStream stream(period, robot_mass, {config.share, config.window},
                     [&](std::uint8_t label) { contact.push_back(label); });
  for (const double force : normal_force) stream.add(force);
  stream.finish();
  return config.annotator ? annotated(contact, period, *config.annotator) : contact;
}

std::array<ContactSequence, models::wheel_count> contact_labels(const logs::Recording& recording,
                                                                const LabelConfig& config) {
  if (recording.truth.size() != recording.steps()) {
    throw InputError(fmt::format("recording of '{}' has no ground truth to label contact with",
                                 recording.info.scenario));
  }
  std::array<ContactSequence, models::wheel_count> labels;
  for (std::size_t wheel = 0; wheel < labels.size(); ++wheel) {
    std::vector<double> force(recording.steps());
    std::transform(
        recording.truth.begin(), recording.truth.end(), force.begin(),
        [&](const models::GroundTruth& truth) { return truth.wheel_normal_force[wheel]; });
    labels[wheel] = contact_labels(force, recording.period(), robot_mass(recording.info), config);
  }
  return labels;
}

std::vector<Flight> flights(const ContactSequence& contact, std::size_t shortest) {
  std::vector<Flight> result;
  for (std::size_t k = 0; k < contact.size(); ++k) {
    if (contact[k] != 0) continue;
    if (k == 0 || contact[k - 1] != 0) result.push_back({k, k});
    result.back().landing = k + 1;
  }
  std::erase_if(result,
                [&](const Flight& flight) { return flight.landing - flight.takeoff < shortest; });
  return result;
}

ContactSequence any_wheel(const std::array<ContactSequence, models::wheel_count>& wheels) {
  return combined(wheels, std::logical_or<>{});
}

ContactSequence both_wheels(const std::array<ContactSequence, models::wheel_count>& wheels) {
  return combined(wheels, std::logical_and<>{});
}

std::vector<std::size_t> drop_segments(const ContactSequence& both_wheels_in_contact,
                                       std::size_t hold_off) {
  std::vector<Flight> drops;
  for (const Flight& flight : flights(both_wheels_in_contact)) {
    if (!drops.empty() && flight.takeoff - drops.back().landing <= hold_off) {
      drops.back().landing = flight.landing;
    } else {
      drops.push_back(flight);
    }
  }
  std::vector<std::size_t> starts = {0};
  for (std::size_t i = 1; i < drops.size(); ++i) {
    starts.push_back((drops[i - 1].landing + drops[i].takeoff) / 2);
  }
  return starts;
}

LabelStream::LabelStream(double period, double robot_mass, const LabelConfig& config, Sink sink)
    : half_window_(static_cast<std::size_t>(0.5 * config.window / period + 1e-9)),
      threshold_(force_threshold(config, robot_mass)),
      sink_(std::move(sink)) {
  if (config.annotator) throw InputError("labels: expected no annotator for a stream of forces");
}

void LabelStream::add(double normal_force) {
  force_.push_back(std::isnan(normal_force) ? 0.0 : normal_force);
  if (force_.size() > next_ + half_window_) label_next();
}

void LabelStream::finish() {
  while (next_ < force_.size()) label_next();
  label_waiting(1);
  force_.clear();
  next_ = 0;
  last_ = 1;
}

void LabelStream::label_next() {
  // Summed anew at every step: a running sum would round, and forces may be infinite.
  const double mean =
      std::accumulate(force_.begin(), force_.end(), 0.0) / static_cast<double>(force_.size());
  const bool has_force = force_[next_] > threshold_;
  if (next_ < half_window_) {
    ++next_;
  } else {
    force_.pop_front();
  }
  if (mean <= threshold_) {
    label_waiting(0);
    sink_(last_ = 0);
  } else if (has_force) {
    label_waiting(1);
    sink_(last_ = 1);
  } else if (last_ == 0) {
    sink_(0);  // the mean rises before the landing
  } else {
    ++waiting_;  // the mean may fall after the takeoff
  }
}

void LabelStream::label_waiting(std::uint8_t contact) {
  for (; waiting_ > 0; --waiting_) sink_(contact);
}

}  // namespace touchdown::scoring
