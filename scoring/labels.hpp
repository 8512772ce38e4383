#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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

/// When a wheel counts as being in contact.
struct LabelConfig {
  double force_threshold = 1.0;  ///< in contact above this normal force (N)
  double debounce = 0.005;       ///< shorter states are merged into their neighbours (s)
};

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
std::vector<std::size_t> drop_pieces(const ContactSequence& both_wheels_in_contact,
                                     std::size_t hold_off);

}  // namespace touchdown::scoring
