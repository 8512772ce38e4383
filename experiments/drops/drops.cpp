#include "experiments/drops/drops.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::experiments {

std::vector<scoring::Flight> drops(
    const std::array<scoring::ContactSequence, models::wheel_count>& contact, double period,
    double minimum_flight, DropWheels wheels) {
  std::vector<scoring::Flight> found =
      scoring::flights(wheels == DropWheels::both   ? scoring::any_wheel(contact)
                       : wheels == DropWheels::left ? contact[0]
                                                    : contact[1]);
  std::erase_if(found, [&](const scoring::Flight& flight) {
    const auto steps = static_cast<double>(flight.landing - flight.takeoff);
    return flight.takeoff == 0 || steps * period < minimum_flight;
  });
  return found;
}

std::string_view to_text(DropWheels wheels) {
  switch (wheels) {
    case DropWheels::both:
      return "both wheels";
    case DropWheels::left:
      return "the left wheel";
    case DropWheels::right:
      return "the right wheel";
  }
  return "";
}

namespace {

std::size_t step_at(const RunSignals& run, double at, double period, const std::string& key) {
  const auto step = static_cast<std::size_t>(std::llround(at / period));
  if (step < run.steps()) return step;
  throw InputError(fmt::format("{}.at: run {} in {} ends after {:.6g} s", key, run.info.run,
                               run.info.simulator, static_cast<double>(run.steps()) * period));
}

std::size_t takeoff_of(const RunSignals& run, const DropChoice& choice, double period,
                       double minimum_flight, const std::string& key) {
  const std::vector<scoring::Flight> found =
      drops(run.contact, period, minimum_flight, choice.wheels);
  const auto number = static_cast<std::size_t>(choice.drop);
  if (number >= found.size()) {
    const std::string have =
        found.empty()
            ? fmt::format("no drop of {}", to_text(choice.wheels))
            : fmt::format("{} drop{} of {}, counted from 0; none is number {}", found.size(),
                          found.size() == 1 ? "" : "s", to_text(choice.wheels), choice.drop);
    throw InputError(
        fmt::format("{}.drop: run {} in {} has {}", key, run.info.run, run.info.simulator, have));
  }
  return found[number].takeoff;
}

}  // namespace

DropWindow drop_window(const RunSignals& run, const DropChoice& choice, double minimum_flight,
                       const std::string& key) {
  const double period = 1e-6 * static_cast<double>(run.info.control_period_us);
  const std::size_t zero = choice.at ? step_at(run, *choice.at, period, key)
                                     : takeoff_of(run, choice, period, minimum_flight, key);
  const auto steps = [&](double seconds) {
    return static_cast<std::size_t>(std::llround(seconds / period));
  };
  return {zero - std::min(zero, steps(choice.before)),
          std::min(run.steps(), zero + steps(choice.after) + 1), zero};
}

std::vector<double> time_in(const DropWindow& window, double period) {
  std::vector<double> time;
  for (std::size_t k = window.begin; k < window.end; ++k) {
    time.push_back((static_cast<double>(k) - static_cast<double>(window.zero)) * period);
  }
  return time;
}

}  // namespace touchdown::experiments
