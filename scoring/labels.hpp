#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "logs/recording.hpp"
#include "models/robot.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::scoring {

/// One contact state per time step: 1 in contact, 0 not.
using ContactSequence = std::vector<std::uint8_t>;

/// Timing errors of a person who labels contact in a film by hand.
struct Annotator {
  double frame = 1.0 / 30.0;   ///< time between frames (s); 0: the annotator sees every step
  double takeoff_delay = 0.0;  ///< marked minus true time of takeoffs (s); negative: early
  double landing_delay = 0.0;  ///< the same of landings (s)
};

/// When a wheel counts as being in contact: docs/reference/metrics.md, "Labels".
struct LabelConfig {
  double share = 0.019;   ///< of the robot's weight; in contact above this mean normal force
  double window = 0.010;  ///< of the mean, centred at the step (s)
  std::optional<Annotator> annotator = {};
};

void describe(Fields& fields, Annotator& annotator);
void describe(Fields& fields, LabelConfig& labels);

/// A maximal interval without contact: steps [takeoff, landing). A flight at the beginning of the
/// sequence has takeoff = 0, one at its end has landing = size.
struct Flight {
  std::size_t takeoff = 0;
  std::size_t landing = 0;

  friend bool operator==(const Flight&, const Flight&) = default;
};

/// The normal force above which a wheel is in contact (N), for a robot of this mass (kg).
double force_threshold(const LabelConfig& config, double robot_mass);

/// The mass of a recording's robot (kg), which its labels need; Upkie's if the recording does not
/// state it.
double robot_mass(const logs::RecordingInfo& info);

/// The annotator's labels of true contact, one state per step of `period` seconds. Flights last
/// from their delayed takeoff to their delayed landing; one that would land before it takes off is
/// lost. Each step has the state of the last frame. The run's ends are no events.
ContactSequence annotated(const ContactSequence& contact, double period,
                          const Annotator& annotator);

/// Contact of one wheel from its normal force (N, one per step of `period` seconds). `robot_mass`
/// is that of the whole robot (kg).
ContactSequence contact_labels(std::span<const double> normal_force, double period,
                               double robot_mass, const LabelConfig& config);

/// Contact of both wheels (left, right) from a simulated run's ground truth.
/// Errors: `InputError` when the recording has no ground truth.
std::array<ContactSequence, models::wheel_count> contact_labels(const logs::Recording& recording,
                                                                const LabelConfig& config);

/// The flights of at least `shortest` steps.
std::vector<Flight> flights(const ContactSequence& contact, std::size_t shortest = 0);

/// Contact of the robot: by at least one wheel, or by both.
ContactSequence any_wheel(const std::array<ContactSequence, models::wheel_count>& wheels);
ContactSequence both_wheels(const std::array<ContactSequence, models::wheel_count>& wheels);

/// Cuts a run into one segment per drop, so that a drop can be the sample of a statistic. A drop is
/// an interval in which a wheel is off the ground, with those that follow within `hold_off` steps
/// (bounces). The cuts are midway between drops. Returns the first step of every segment; the first
/// is 0.
std::vector<std::size_t> drop_segments(const ContactSequence& both_wheels_in_contact,
                                       std::size_t hold_off);

/// `contact_labels` of one wheel for forces that arrive one by one. Each label comes at most two
/// windows late, so the memory does not grow with the run.
class LabelStream {
 public:
  using Sink = std::function<void(std::uint8_t contact)>;

  /// `period` in seconds, `robot_mass` in kg; `sink` gets one label per force, in order.
  /// Errors: `InputError` if `config` has an annotator, who needs the whole run.
  LabelStream(double period, double robot_mass, const LabelConfig& config, Sink sink);

  /// Normal force of the next step (N). NaN counts as none.
  void add(double normal_force);
  /// Ends the run: labels the remaining steps.
  void finish();

 private:
  void label_next();
  void label_waiting(std::uint8_t contact);

  std::size_t half_window_;  ///< steps on both sides of the one that is labelled
  double threshold_;
  Sink sink_;
  std::deque<double> force_;  ///< of the steps in the window of the next label
  std::size_t next_ = 0;      ///< index of that step in `force_`
  /// Steps without force between two with it: they are a landing or takeoff if the mean says so
  /// next to them, else chatter.
  std::size_t waiting_ = 0;
  std::uint8_t last_ = 1;  ///< label before the waiting steps
};

}  // namespace touchdown::scoring
