#pragma once

#include <algorithm>
#include <array>

namespace touchdown {

/// When P(contact) changes a wheel's decision. It leaves contact when P falls below `leave_below`
/// and returns when P rises above `return_above`.
///
/// Between these thresholds a decision that contradicts its probability does not last: P that stays
/// on the other side of `settle_at`, limited to the thresholds, changes it after `settle_after`.
struct OperatingPoint {
  double leave_below = 0.5;
  double return_above = 0.5;
  double settle_at = 0.9;
  double settle_after = 0.0;  ///< s; 0: thresholds alone decide

  bool operator==(const OperatingPoint&) const = default;
};

/// The names of its numbers in configurations.
inline constexpr std::array<const char*, 4> operating_point_keys = {"leave_below", "return_above",
                                                                    "settle_at", "settle_after"};

/// One wheel's decision by an operating point.
class ContactDecision {
 public:
  /// The decision at this step, `elapsed` seconds after that of the previous one, `before`.
  bool update(bool before, double p_contact, double elapsed, const OperatingPoint& point) noexcept {
    bool is_contact = before ? p_contact >= point.leave_below : p_contact > point.return_above;
    if (point.settle_after > 0.0 && is_contact == before) {
      const double settle_at = std::clamp(point.settle_at, point.leave_below, point.return_above);
      contradicted_ = before == (p_contact > settle_at) ? 0.0 : contradicted_ + elapsed;
      constexpr double rounding = 1e-6;  // of times
      if (contradicted_ >= point.settle_after - rounding) is_contact = !before;
    }
    if (is_contact != before) contradicted_ = 0.0;
    return is_contact;
  }

  /// After a step without a probability.
  void reset() noexcept { contradicted_ = 0.0; }

 private:
  double contradicted_ = 0.0;  ///< s
};

}  // namespace touchdown
