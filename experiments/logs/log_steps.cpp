#include "experiments/logs/log_steps.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.hpp"
#include "logs/sample_times.hpp"

namespace touchdown::experiments {

namespace {

/// The rate of the log (Hz). A simulated log specifies its own.
double usable_rate(logs::LogReader& reader) {
  const logs::RecordingInfo& info = reader.info();
  const double measured = 1e6 / static_cast<double>(info.control_period_us);
  const double rate = info.simulator.empty() ? logs::nominal_rate(measured) : measured;
  constexpr double lowest = 100.0;
  constexpr double highest = 20'000.0;
  if (!(rate >= lowest && rate <= highest)) {
    throw InputError(
        fmt::format("{}: {:.4g} steps per second: expected 100 to 20000", reader.name(), rate));
  }
  return rate;
}

/// Stand-ins for the forces of a log with labels of contact alone.
std::optional<std::array<double, models::wheel_count>> forces(const logs::ContactInterval* label) {
  if (label == nullptr) return std::nullopt;
  constexpr double some_force = std::numeric_limits<double>::infinity();
  return {{label->contact[0] ? some_force : 0.0, label->contact[1] ? some_force : 0.0}};
}

}  // namespace

LogSteps::LogSteps(logs::LogReader& reader, const logs::ContactIntervals* labels,
                   const logs::CheckedRobot& robot)
    : reader_(reader),
      labels_(labels),
      sample_rate_(usable_rate(reader)),
      period_us_(std::llround(1e6 / sample_rate_)),
      signals_(sample_rate_),
      plausibility_(1.0 / sample_rate_, robot) {}

const LogStep* LogSteps::next() {
  const std::optional<logs::LogRow> row = reader_.next();
  if (!row) return nullptr;
  plausibility_.add(row->observation);
  step_.signals = signals_.next(row->observation, row->action);
  step_.normal_force.reset();
  if (labels_ != nullptr) {
    step_.normal_force = forces(labels_->at(row->observation.time));
  } else if (row->truth) {
    const auto& force = row->truth->wheel_normal_force;
    if (!std::isnan(force[0]) && !std::isnan(force[1])) step_.normal_force = force;
  }
  return &step_;
}

}  // namespace touchdown::experiments
