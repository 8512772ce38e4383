#include "estimator/phase/labels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "estimator/torque_channel.hpp"

namespace touchdown {
namespace {

constexpr double gravity = 9.81;
constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

/// The sequence, with contact filled in wherever it is missing for fewer than `steps` steps.
std::vector<std::uint8_t> without_short_flights(WheelContact contact, std::size_t steps) {
  std::vector<std::uint8_t> filled(contact.begin(), contact.end());
  auto begin = filled.begin();
  while (begin != filled.end()) {
    const auto end = std::find_if(begin, filled.end(), [&](auto c) { return c != *begin; });
    if (*begin == 0 && static_cast<std::size_t>(end - begin) < steps) {
      std::fill(begin, end, std::uint8_t{1});
    }
    begin = end;
  }
  return filled;
}

/// For every step, its distance (steps) from the last step with a wheel in the air, in the order of
/// the indices from `at`: 0 in the air, 1 right beside it, `never` without any.
template <typename At>
std::vector<std::size_t> steps_from_air(const std::vector<std::uint8_t>& both, const At& at) {
  std::vector<std::size_t> steps(both.size());
  std::size_t count = never;
  for (std::size_t i = 0; i < both.size(); ++i) {
    const std::size_t k = at(i);
    count = both[k] == 0 ? 0 : (count == never ? never : count + 1);
    steps[k] = count;
  }
  return steps;
}

/// The phase with both wheels on the ground, `after` steps after a landing and `before` steps
/// before a takeoff.
Phase phase_on_the_ground(std::size_t after, std::size_t before, double sample_rate,
                          const PhaseLabelConfig& config) {
  const auto seconds = [&](std::size_t steps) {
    // Subtracts half a step, so that rounding does not decide.
    return steps == never ? std::numeric_limits<double>::infinity()
                          : (static_cast<double>(steps) - 0.5) / sample_rate;
  };
  if (before <= after) {
    const double time = seconds(before);
    if (time < config.unloading[2]) return Phase::unloading_3;
    if (time < config.unloading[1]) return Phase::unloading_2;
    if (time < config.unloading[0]) return Phase::unloading_1;
  } else {
    const double time = seconds(after);
    if (time < config.impact[0]) return Phase::impact_1;
    if (time < config.impact[1]) return Phase::impact_2;
    if (time < config.impact[2]) return Phase::impact_3;
  }
  return Phase::rolling;
}

}  // namespace

void check_phase_labels(const PhaseLabelConfig& config) {
  const auto& u = config.unloading;
  const auto& i = config.impact;
  if (!(u[0] >= u[1] && u[1] >= u[2] && u[2] >= 0.0 && std::isfinite(u[0]))) {
    throw InputError("phase labels: unloading times must decrease and not be negative (s)");
  }
  if (!(i[0] >= 0.0 && i[0] <= i[1] && i[1] <= i[2] && std::isfinite(i[2]))) {
    throw InputError("phase labels: impact times must increase and not be negative (s)");
  }
  if (!(config.shortest_flight >= 0.0 && config.held_low_pass >= 0.0 && config.held_margin >= 0.0 &&
        config.carried_load >= 0.0 && config.carried_low_pass >= 0.0)) {
    throw InputError(
        "phase labels: shortest_flight, held_low_pass, held_margin, carried_load and "
        "carried_low_pass must not be negative");
  }
}

std::vector<std::uint8_t> held_steps(std::span<const Signals> signals, double sample_rate,
                                     const PhaseLabelConfig& config) {
  const double gain = low_pass_gain(config.held_low_pass, 1.0 / sample_rate);
  std::vector<std::uint8_t> held(signals.size());
  double filtered = signals.empty() ? 0.0 : signals.front().vertical_acceleration;
  for (std::size_t k = 0; k < signals.size(); ++k) {
    const double acceleration = signals[k].vertical_acceleration;
    if (std::isfinite(acceleration)) filtered += gain * (acceleration - filtered);
    held[k] = std::abs(filtered + gravity) > config.held_margin ? 1 : 0;
  }
  return held;
}

std::vector<std::uint8_t> carried_steps(const std::array<std::span<const double>, 2>& normal_force,
                                        std::span<const std::uint8_t> held, double sample_rate,
                                        const PhaseLabelConfig& config) {
  const std::size_t steps = held.size();
  if (normal_force[0].size() != steps || normal_force[1].size() != steps) {
    throw InputError("phase labels: normal forces and `held` must be equally long");
  }
  const double gain = low_pass_gain(config.carried_low_pass, 1.0 / sample_rate);
  std::vector<std::uint8_t> carried(steps);
  double filtered = steps == 0 ? 0.0 : normal_force[0][0] + normal_force[1][0];
  for (std::size_t k = 0; k < steps; ++k) {
    filtered += gain * (normal_force[0][k] + normal_force[1][k] - filtered);
    carried[k] = held[k] != 0 && filtered < config.carried_load ? 1 : 0;
  }
  return carried;
}

std::vector<Phase> label_phases(const std::array<WheelContact, 2>& contact,
                                std::span<const std::uint8_t> held, double sample_rate,
                                const PhaseLabelConfig& config,
                                std::span<const std::uint8_t> carried) {
  check_phase_labels(config);
  const std::size_t steps = contact[0].size();
  if (contact[1].size() != steps || !(held.empty() || held.size() == steps) ||
      !(carried.empty() || carried.size() == steps)) {
    throw InputError(
        "phase labels: contact of both wheels, `held` and `carried` must be equally long");
  }
  const auto shortest =
      static_cast<std::size_t>(std::llround(config.shortest_flight * sample_rate));
  const std::vector<std::uint8_t> left = without_short_flights(contact[0], shortest);
  const std::vector<std::uint8_t> right = without_short_flights(contact[1], shortest);
  std::vector<std::uint8_t> both(steps);
  std::transform(left.begin(), left.end(), right.begin(), both.begin(),
                 [](auto l, auto r) { return std::uint8_t{l != 0 && r != 0}; });

  const auto after = steps_from_air(both, [](std::size_t i) { return i; });
  const auto before = steps_from_air(both, [&](std::size_t i) { return steps - 1 - i; });

  std::vector<Phase> phases(steps);
  for (std::size_t k = 0; k < steps; ++k) {
    if (left[k] != 0 && right[k] != 0) {
      phases[k] = !carried.empty() && carried[k] != 0
                      ? Phase::carried
                      : phase_on_the_ground(after[k], before[k], sample_rate, config);
    } else if (left[k] != 0) {
      phases[k] = Phase::left_only;
    } else if (right[k] != 0) {
      phases[k] = Phase::right_only;
    } else {
      phases[k] = !held.empty() && held[k] != 0 ? Phase::held : Phase::flight;
    }
  }
  return phases;
}

}  // namespace touchdown
