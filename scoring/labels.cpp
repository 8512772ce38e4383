#include "scoring/labels.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/fields.hpp"

namespace touchdown::scoring {

namespace {

/// A maximal interval of steps [begin, end) in one state.
struct StateInterval {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::uint8_t state = 0;

  std::size_t length() const { return end - begin; }
};

std::vector<StateInterval> state_intervals(const ContactSequence& contact) {
  std::vector<StateInterval> result;
  for (std::size_t k = 0; k < contact.size(); ++k) {
    if (k == 0 || contact[k] != contact[k - 1]) result.push_back({k, k, contact[k]});
    result.back().end = k + 1;
  }
  return result;
}

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
  fields("force_threshold", labels.force_threshold, 0.0, 1e4)
      .doc("N", "A wheel is in contact above this normal force.");
  fields("debounce", labels.debounce, 0.0, 10.0)
      .doc("s", "Shorter states are merged into their neighbours.");
  fields.section("annotator", labels.annotator)
      .doc("Timing errors of a person who labels contact in a film.");
}

ContactSequence debounced(ContactSequence contact, std::size_t steps) {
  std::vector<StateInterval> parts = state_intervals(contact);
  while (parts.size() > 1) {
    const auto shortest = std::ranges::min_element(parts, {}, &StateInterval::length);
    if (shortest->length() >= steps) break;
    const bool has_left = shortest != parts.begin();
    const bool has_right = shortest + 1 != parts.end();
    StateInterval merged = *shortest;
    merged.state = shortest->state == 0 ? 1 : 0;
    if (has_left) merged.begin = (shortest - 1)->begin;
    if (has_right) merged.end = (shortest + 1)->end;
    const auto first = has_left ? shortest - 1 : shortest;
    *first = merged;
    parts.erase(first + 1, has_right ? shortest + 2 : shortest + 1);
  }
  for (const StateInterval& part : parts) {
    std::fill(contact.begin() + static_cast<std::ptrdiff_t>(part.begin),
              contact.begin() + static_cast<std::ptrdiff_t>(part.end), part.state);
  }
  return contact;
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
                               const LabelConfig& config) {
  ContactSequence contact(normal_force.size());
  std::transform(normal_force.begin(), normal_force.end(), contact.begin(),
                 [&](double force) { return std::uint8_t{force > config.force_threshold}; });
  contact = debounced(std::move(contact),
                      static_cast<std::size_t>(std::llround(config.debounce / period)));
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
    labels[wheel] = contact_labels(force, recording.period(), config);
  }
  return labels;
}

std::vector<Flight> flights(const ContactSequence& contact, std::size_t shortest) {
  std::vector<Flight> result;
  for (const StateInterval& part : state_intervals(contact)) {
    const bool is_flight = part.state == 0 && part.end - part.begin >= shortest;
    if (is_flight) result.push_back({part.begin, part.end});
  }
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

LabelStream::LabelStream(double period, const LabelConfig& config, Sink sink)
    : steps_(static_cast<std::size_t>(std::max(std::llround(config.debounce / period), 1LL))),
      longest_chatter_(steps_ + static_cast<std::size_t>(std::llround(60.0 / period))),
      threshold_(config.force_threshold),
      sink_(std::move(sink)) {
  if (config.annotator) throw InputError("labels: expected no annotator for a stream of forces");
}

void LabelStream::add(double normal_force) {
  const std::uint8_t contact{normal_force > threshold_};
  duration_ = !pending_.empty() && pending_.back() == contact ? duration_ + 1 : 1;
  if (duration_ > steps_) {  // the state is settled, and no step waits for its label
    sink_(contact);
    return;
  }
  pending_.push_back(contact);
  if (duration_ >= steps_ || pending_.size() > longest_chatter_) label_settled();
}

void LabelStream::finish() {
  label_settled();
  pending_.clear();
  labelled_ = duration_ = 0;
}

void LabelStream::label_settled() {
  const ContactSequence labels = debounced(pending_, steps_);
  for (std::size_t k = labelled_; k < labels.size(); ++k) sink_(labels[k]);
  // Keep as much of the last interval as it needs to keep its state.
  const std::size_t kept = std::min(labels.size(), steps_);
  pending_.assign(labels.end() - static_cast<std::ptrdiff_t>(kept), labels.end());
  labelled_ = kept;
}

}  // namespace touchdown::scoring
