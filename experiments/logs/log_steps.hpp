#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "estimator/assembly/signal_assembler.hpp"
#include "recordings/beliefs/contact_intervals.hpp"
#include "recordings/log/reader.hpp"
#include "recordings/signals_from.hpp"

namespace touchdown::experiments {

/// What one step of a log says to an estimator, and the truth about its wheels where the log has
/// it, or somebody says it.
struct LogStep {
  Signals signals;
  /// Normal force on the left and the right wheel (N); infinite for a wheel that touches with an
  /// unknown force.
  std::optional<std::array<double, models::wheel_count>> normal_force;
};

/// Listens to a log as an estimator does, step by step.
class LogSteps {
 public:
  /// `reader` must outlive the listener. With `labels`, which must too, the truth is what they say,
  /// whatever the log says itself. Errors: those of the reader; `InputError` for a log with
  /// less than 100 steps per second, in which every step would be a gap (`SignalGuardConfig`), or
  /// with more than 20,000.
  explicit LogSteps(recordings::LogReader& reader,
                       const recordings::ContactIntervals* labels = nullptr);

  /// The next step, valid until the next call; null at the end of the log.
  const LogStep* next();

  /// What the log says, or for a robot's log the median step, taken for a whole multiple of 0.5 ms
  /// if it is one within 2 %: clocks jitter, and some estimators know only certain rates.
  std::int64_t period_us() const { return period_us_; }
  double period() const { return 1e-6 * static_cast<double>(period_us_); }
  double sample_rate() const { return 1e6 / static_cast<double>(period_us_); }

  /// At how many steps so far the IMU's orientation contradicted gravity: their vertical
  /// acceleration is NaN.
  std::uint64_t upside_down() const { return assembler_.count(RecordFault::upside_down); }

 private:
  recordings::LogReader& reader_;
  const recordings::ContactIntervals* labels_;
  std::int64_t period_us_;
  SignalAssembler assembler_;
  recordings::RecordedJoints joints_;
  double command_ = 0.0;
  LogStep step_;
};

}  // namespace touchdown::experiments
