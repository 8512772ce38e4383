#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/signals/run_signals.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

/// The drops of a run: flights of these wheels that begin after the run's first step and last at
/// least `minimum_flight` seconds, in order.
std::vector<scoring::Flight> drops(
    const std::array<scoring::ContactSequence, models::wheel_count>& contact, double period,
    double minimum_flight, DropWheels wheels = DropWheels::both);

/// "both wheels", "the left wheel", "the right wheel".
std::string_view to_text(DropWheels wheels);

/// The steps that a picture of one drop, or moment, shows: [begin, end), inside the run.
struct DropWindow {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t zero = 0;  ///< of the takeoff, or the moment

  std::size_t steps() const { return end - begin; }
};

/// Where the chosen drop is. `key` is the choice's place in the experiment file.
/// Errors: `InputError` beginning with the key and saying how many drops the run has, or how long
/// it is.
DropWindow drop_window(const RunSignals& run, const DropChoice& choice, double minimum_flight,
                       const std::string& key);

/// Time since the takeoff, or the moment, at every step of the window (s).
std::vector<double> time_in(const DropWindow& window, double period);

}  // namespace touchdown::experiments
