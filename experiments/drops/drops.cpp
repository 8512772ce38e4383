#include "experiments/drops/drops.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::experiments {

std::vector<scoring::Flight> drops(
    const std::array<scoring::ContactSequence, models::wheel_count>& contact, double period,
    double minimum_flight) {
  std::vector<scoring::Flight> found = scoring::flights(scoring::any_wheel(contact));
  std::erase_if(found, [&](const scoring::Flight& flight) {
    const auto steps = static_cast<double>(flight.landing - flight.takeoff);
    return flight.takeoff == 0 || steps * period < minimum_flight;
  });
  return found;
}

DropWindow drop_window(const RunSignals& run, const DropChoice& choice, double minimum_flight,
                       const std::string& key) {
  const double period = 1e-6 * static_cast<double>(run.info.control_period_us);
  const std::vector<scoring::Flight> found = drops(run.contact, period, minimum_flight);
  const auto number = static_cast<std::size_t>(choice.drop);
  if (number >= found.size()) {
    const std::string have =
        found.empty() ? "no drop"
                      : fmt::format("{} drop{}, counted from 0; none is number {}", found.size(),
                                    found.size() == 1 ? "" : "s", choice.drop);
    throw InputError(
        fmt::format("{}.drop: run {} in {} has {}", key, run.info.run, run.info.simulator, have));
  }
  const scoring::Flight drop = found[number];
  const auto steps = [&](double seconds) {
    return static_cast<std::size_t>(std::llround(seconds / period));
  };
  return {drop.takeoff - std::min(drop.takeoff, steps(choice.before)),
          std::min(run.steps(), drop.takeoff + steps(choice.after) + 1), drop};
}

std::vector<double> time_since_takeoff(const DropWindow& window, double period) {
  std::vector<double> time;
  for (std::size_t k = window.begin; k < window.end; ++k) {
    time.push_back((static_cast<double>(k) - static_cast<double>(window.drop.takeoff)) * period);
  }
  return time;
}

}  // namespace touchdown::experiments
