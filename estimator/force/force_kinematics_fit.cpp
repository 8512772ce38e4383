#include "estimator/force/force_kinematics_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/error.hpp"

namespace touchdown {

namespace {

/// The observations of one state.
struct StateStatistics {
  double count = 0.0;
  double force = 0.0;
  double force_squares = 0.0;  ///< about the mean so far
  double axle_squares = 0.0;
  double seconds = 0.0;
  double departures = 0.0;

  void add(const WheelObservation& observation) {
    count += 1.0;
    const double apart = observation.force - force;
    force += apart / count;
    force_squares += apart * (observation.force - force);
    axle_squares += observation.axle_velocity * observation.axle_velocity;
  }

  [[nodiscard]] WheelState state(const ForceKinematicsFloors& floors) const {
    const auto deviation = [&](double squares, double floor) {
      return std::max(std::sqrt(squares / count), floor);
    };
    return {.force_mean = force,
            .force_deviation = deviation(force_squares, floors.force),
            .axle_deviation = deviation(axle_squares, floors.axle_velocity),
            .leaving_rate = std::max(departures / seconds, floors.leaving_rate)};
  }
};

using StatisticsByState = std::array<StateStatistics, 2>;  // without and with contact

void count_durations(const LabelledRun& run, StatisticsByState& states) {
  for (const std::span<const std::uint8_t>& contact : run.contact) {
    for (std::size_t k = run.skip; k < contact.size(); ++k) {
      states[contact[k] != 0 ? 1 : 0].seconds += 1.0 / run.sample_rate;
      const bool is_left = k + 1 < contact.size() && (contact[k] != 0) != (contact[k + 1] != 0);
      if (is_left) states[contact[k] != 0 ? 1 : 0].departures += 1.0;
    }
  }
}

}  // namespace

ForceKinematicsModel fit_force_kinematics(std::span<const LabelledRun> runs,
                                          const ForceKinematicsConfig& config,
                                          const ForceKinematicsFloors& floors) {
  StatisticsByState states;
  for (const LabelledRun& run : runs) {
    check_labels(run);
    ForceKinematicsConfig own = config;
    own.sample_rate = run.sample_rate;
    WheelObservations observations(own);
    for (std::size_t k = 0; k < run.signals.size(); ++k) {
      const WheelLoads::Step step = observations.update(run.signals[k]);
      for (std::size_t side = 0; side < 2; ++side) {
        if (k < run.skip || !step.is_measured[side]) continue;
        states[run.contact[side][k] != 0 ? 1 : 0].add(observations.of(side));
      }
    }
    count_durations(run, states);
  }
  if (!(states[0].count > 0.0 && states[1].count > 0.0)) {
    throw InputError("force kinematics: steps in contact and without are needed");
  }
  return {.air = states[0].state(floors), .contact = states[1].state(floors)};
}

}  // namespace touchdown
