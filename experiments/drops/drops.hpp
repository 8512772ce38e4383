#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/signals/run_signals.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

/// The drops of a run, in order of time: flights of these wheels that begin after the run's first
/// step and last at least `minimum_flight` (s).
std::vector<scoring::Flight> drops(
    const std::array<scoring::ContactSequence, models::wheel_count>& contact, double period,
    double minimum_flight, DropWheels wheels = DropWheels::both);

/// "both wheels", "the left wheel", "the right wheel".
std::string_view to_text(DropWheels wheels);

/// The steps around one drop, or one time, that a figure shows: [begin, end), inside the run.
struct DropWindow {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t zero = 0;  ///< step of the takeoff, or of the chosen time

  std::size_t steps() const { return end - begin; }
};

/// The window around the chosen drop. `key` is the choice's key in the experiment file.
/// Errors: `InputError` that begins with the key and states the number of drops, or the duration,
/// of the run.
DropWindow drop_window(const RunSignals& run, const DropChoice& choice, double minimum_flight,
                       const std::string& key);

/// Time since the takeoff, or the chosen time, at every step of the window (s).
std::vector<double> time_in(const DropWindow& window, double period);

}  // namespace touchdown::experiments
