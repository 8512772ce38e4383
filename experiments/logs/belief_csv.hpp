#pragma once

#include <ostream>

#include <fmt/format.h>

#include "estimator/contact_estimator.hpp"

namespace touchdown::experiments {

/// Writes beliefs as comma-separated values, one line per step: time (s), contact probability and
/// decision (1 or 0) of each wheel, P(any wheel in contact), P(both wheels in contact), P(takeoff)
/// and P(landing) of the transition model, status. Numbers are the shortest that read back to the
/// same bits; `nan` stands for values that an estimator does not compute.
class BeliefCsv {
 public:
  /// Writes the header. `stream` must outlive this.
  explicit BeliefCsv(std::ostream& stream);

  /// Buffers lines and writes them every 64 kB. Errors: `Error` when the stream fails.
  void write(double time, const Belief& belief, const Evidence& evidence);

  /// Writes the buffered lines. Errors: as above.
  void flush();

 private:
  std::ostream& stream_;
  fmt::memory_buffer buffer_;
};

}  // namespace touchdown::experiments
