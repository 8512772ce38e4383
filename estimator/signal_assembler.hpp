#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "estimator/record.hpp"
#include "estimator/stopped_signals.hpp"

namespace touchdown {

/// Faults of a record; several may occur at once.
enum class RecordFault : std::uint32_t {
  joint_missing = 1U << 0U,         ///< a position, velocity or torque is not a finite number
  joint_stale = 1U << 1U,           ///< a servo repeats itself to the bit
  orientation_missing = 1U << 2U,   ///< the quaternion does not have length one
  upside_down = 1U << 3U,           ///< the orientation turns gravity upside down
  acceleration_missing = 1U << 4U,  ///< neither acceleration is finite
  clock_missing = 1U << 5U,         ///< the time is not a finite number
  clock_back = 1U << 6U,            ///< time went back
  clock_gap = 1U << 7U,             ///< records were lost
  clock_rate = 1U << 8U,            ///< the records' rate is not the configured one
  signal_stopped = 1U << 9U,        ///< a signal repeats itself to the bit (`StoppedSignals`)
};
inline constexpr std::size_t record_fault_count = 10;

/// "joint missing", "upside down", …
std::string_view to_text(RecordFault fault) noexcept;

/// The faults of one record.
struct RecordFaults {
  std::uint32_t bits = 0;

  void add(RecordFault fault) noexcept { bits |= static_cast<std::uint32_t>(fault); }
  [[nodiscard]] bool has(RecordFault fault) const noexcept {
    return (bits & static_cast<std::uint32_t>(fault)) != 0;
  }
  [[nodiscard]] bool any() const noexcept { return bits != 0; }
};

/// Turns a robot's records into the signals that estimators use, step by step. It converts the
/// joints' order, signs and units and the IMU's axes, and computes the vertical acceleration. It
/// checks the clock, the servos, and the IMU's orientation against gravity. Unusable values become
/// NaN, which estimators handle; `faults()` gives the reasons.
///
/// `assemble` never throws, allocates or locks.
class SignalAssembler {
 public:
  /// Throws InputError as `check_assembly_config` does.
  explicit SignalAssembler(const AssemblyConfig& config = {});

  void reset() noexcept;

  [[nodiscard]] const AssemblyConfig& config() const noexcept { return config_; }

  const Signals& assemble(const RobotRecord& record) noexcept;

  /// The faults of the last record.
  [[nodiscard]] RecordFaults faults() const noexcept { return faults_; }
  /// How many records had this fault since the last reset.
  [[nodiscard]] std::uint64_t count(RecordFault fault) const noexcept;

 private:
  /// Turns motors of closed legs into hips and knees.
  void take_motors(const ImuSignals& imu) noexcept;
  void watch_clock() noexcept;
  void watch_joints() noexcept;
  void watch_imu(const ImuSignals& imu) noexcept;

  AssemblyConfig config_;
  double gravity_gain_;
  Signals signals_;
  RecordFaults faults_;
  std::array<std::uint64_t, record_fault_count> counts_{};

  bool started_ = false;
  double time_ = 0.0;           ///< of the last record that has a time (s)
  double steps_time_ = 0.0;     ///< sum of the steps that are not gaps (s) …
  int steps_ = 0;               ///< … and their number
  bool is_rate_wrong_ = false;  ///< as of the last check
  double upward_ = 0.0;         ///< low-passed proper acceleration along the vertical (m/s²)
  StoppedSignals stopped_;
  std::array<JointSignals, 6> last_{};
  std::array<double, 6> repeated_{};  ///< for how long each servo has repeated itself (s)
};

}  // namespace touchdown
