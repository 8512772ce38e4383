#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "models/robot.hpp"
#include "recordings/recording.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::scoring {

/// One contact state per time step: 1 in contact, 0 not.
using ContactSequence = std::vector<std::uint8_t>;

/// A person who labels a film by hand.
struct Annotator {
  double frame = 1.0 / 30.0;  ///< time from one picture to the next; 0: a film without pictures (s)
  double takeoff_delay = 0.0;  ///< takeoffs are marked this much after they were, or before (s)
  double landing_delay = 0.0;  ///< landings, likewise (s)
};

/// When a wheel counts as being in contact.
struct LabelConfig {
  double force_threshold = 1.0;  ///< in contact above this normal force (N)
  double debounce = 0.005;       ///< shorter states are merged into their neighbours (s)
  std::optional<Annotator> annotator = {};
};

void describe(Fields& fields, Annotator& annotator);
void describe(Fields& fields, LabelConfig& labels);

/// A maximal stretch without contact: steps [takeoff, landing). A flight that the sequence begins
/// with has takeoff = 0, one that it ends with has landing = size.
struct Flight {
  std::size_t takeoff = 0;
  std::size_t landing = 0;

  friend bool operator==(const Flight&, const Flight&) = default;
};

/// Merge every state that lasts fewer than `steps` steps into its neighbours, the shortest first
/// (the earlier of two equals), until none is left or only one state remains.
ContactSequence debounced(ContactSequence contact, std::size_t steps);

/// What the annotator makes of contact that was so, one state per step of `period` seconds: that of
/// the last picture, with flights from their late takeoffs to their late landings. One that would
/// land before it takes off is not seen; the run's ends are no events.
ContactSequence annotated(const ContactSequence& contact, double period,
                          const Annotator& annotator);

/// Contact of one wheel from its normal force (N, one per step of `period` seconds).
ContactSequence contact_labels(std::span<const double> normal_force, double period,
                               const LabelConfig& config);

/// Contact of both wheels (left, right) from a simulated run's ground truth.
/// Errors: `InputError` when the recording has no ground truth.
std::array<ContactSequence, models::wheel_count> contact_labels(
    const recordings::Recording& recording, const LabelConfig& config);

std::vector<Flight> flights(const ContactSequence& contact);

/// Contact of the robot: by at least one wheel, or by both.
ContactSequence any_wheel(const std::array<ContactSequence, models::wheel_count>& wheels);
ContactSequence both_wheels(const std::array<ContactSequence, models::wheel_count>& wheels);

/// Cuts a run into one piece per drop, so that a drop can be the sample of a statistic: a drop is a
/// stretch in which a wheel is off the ground, together with the ones that follow within `hold_off`
/// steps (bounces); the cuts lie midway between drops. Returns the first step of every piece,
/// beginning with 0.
std::vector<std::size_t> drop_segments(const ContactSequence& both_wheels_in_contact,
                                     std::size_t hold_off);

/// `contact_labels` of one wheel for forces that come one by one: the same labels, each as soon as
/// no later force can change it, at a memory that does not grow with the run. A stretch that lasts
/// as long as the debounce keeps its state for good, so what lies between two of them is labelled
/// when the second one is. (Chatter that lasts for a minute is labelled in pieces.)
class LabelStream {
 public:
  using Sink = std::function<void(std::uint8_t contact)>;

  /// `period` in seconds; `sink` gets one label per force, in their order.
  /// Errors: `InputError` for an annotator, who sees whole films.
  LabelStream(double period, const LabelConfig& config, Sink sink);

  /// Normal force of the next step (N).
  void add(double normal_force);
  /// The run is over: labels what is left.
  void finish();

 private:
  void settle();

  std::size_t steps_;
  std::size_t longest_chatter_;
  double threshold_;
  Sink sink_;
  ContactSequence pending_;   ///< first what is labelled and still decides about the rest
  std::size_t labelled_ = 0;  ///< at the beginning of `pending_`
  std::size_t duration_ = 0;   ///< steps that the last state has lasted
};

}  // namespace touchdown::scoring
