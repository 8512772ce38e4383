#pragma once

namespace touchdown {

/// An estimate with its interval; NaN if undefined.
struct Interval {
  double estimate = 0.0;
  double low = 0.0;
  double high = 0.0;
};

}  // namespace touchdown
