#include "experiments/logs/log_steps.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::experiments {

namespace {

std::int64_t nominal_period_us(const recordings::RecordingInfo& info) {
  constexpr std::int64_t raster = 500;
  const std::int64_t period = info.control_period_us;
  const std::int64_t nearest = (period + raster / 2) / raster * raster;
  constexpr std::int64_t percent = 2;
  const bool jitters = nearest > 0 && 100 * std::abs(period - nearest) <= percent * period;
  return info.simulator.empty() && jitters ? nearest : period;
}

std::int64_t usable_period_us(recordings::LogReader& reader) {
  const std::int64_t period = nominal_period_us(reader.info());
  constexpr std::int64_t shortest = 50;
  constexpr std::int64_t longest = 10'000;
  if (period < shortest || period > longest) {
    throw InputError(fmt::format("{}: {:.4g} steps per second: expected 100 to 20000",
                                 reader.name(), 1e6 / static_cast<double>(period)));
  }
  return period;
}

/// Repeated values are no fault: a simulated robot at rest reports the same values again.
AssemblyConfig assembly_of(std::int64_t period_us) {
  return {.sample_rate = 1e6 / static_cast<double>(period_us), .stale_after = 0.0};
}

/// Stand-ins for the forces of a log with labels of contact alone.
std::optional<std::array<double, models::wheel_count>> forces(
    const recordings::ContactInterval* label) {
  if (label == nullptr) return std::nullopt;
  constexpr double some_force = std::numeric_limits<double>::infinity();
  return {{label->contact[0] ? some_force : 0.0, label->contact[1] ? some_force : 0.0}};
}

}  // namespace

LogSteps::LogSteps(recordings::LogReader& reader, const recordings::ContactIntervals* labels)
    : reader_(reader),
      labels_(labels),
      period_us_(usable_period_us(reader)),
      assembler_(assembly_of(period_us_)) {}

const LogStep* LogSteps::next() {
  const std::optional<recordings::LogRow> row = reader_.next();
  if (!row) return nullptr;
  step_.signals = assembler_.assemble(recordings::record_of(row->observation, command_, joints_));
  command_ = recordings::ground_velocity_command(row->action);
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
