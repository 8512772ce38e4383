#pragma once

#include <optional>

#include "recordings/plausibility/window.hpp"

namespace touchdown::recordings {

/// Finds stretches of half a second in which the robot neither turns nor moves its legs: it stands,
/// or hangs. Such a robot accelerates little on average, so that its accelerometer shows gravity
/// alone, and its legs carry its weight, or nothing.
class StillStretches {
 public:
  /// Adds the next window. Returns the means over a stretch that it completes, if any.
  std::optional<CheckedWindow> add(const CheckedWindow& window);

 private:
  CheckedWindow sum_;
  int count_ = 0;
};

}  // namespace touchdown::recordings
