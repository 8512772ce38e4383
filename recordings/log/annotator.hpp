#pragma once

#include <array>
#include <ostream>
#include <string_view>

#include "estimator/contact_estimator.hpp"
#include "recordings/log/outline.hpp"
#include "recordings/log/packing.hpp"

namespace touchdown::recordings {

/// What an estimator made of one step, by the names under which the authors' contact_agent logs it,
/// which filters the left leg only; and under `observation.contact_filter`, what we know besides.
/// NaN for what an estimator does not compute.
struct LogBeliefs {
  /// `observation.measurement_model`
  double contact_likelihood = 0.0;
  double no_contact_likelihood = 0.0;
  double measurement_p_contact = 0.0;
  /// `observation.transition_model`
  double power = 0.0;
  double median_frequency = 0.0;           ///< Hz
  double filtered_median_frequency = 0.0;  ///< Hz
  double p_switch = 0.0;
  double p_landing = 0.0;
  double p_landing_p_switch = 0.0;
  double p_takeoff_p_switch = 0.0;
  /// `observation.contact_filter`
  double p_contact = 0.0;
  double p_contact_smooth = 0.0;
  /// `observation.contact_filter.{left,right}_wheel.{p_contact,contact}`
  std::array<WheelBelief, 2> wheel;
  double p_any_wheel = 0.0;
  double p_both_wheels = 0.0;
  /// `observation.contact_filter.status`
  SignalStatus status = SignalStatus::good;
};

/// Copies a log record by record and writes beliefs into it, at a constant memory. Everything else
/// in a record stays as it was, byte for byte; beliefs that a record has already are replaced.
class LogAnnotator {
 public:
  /// `stream` must outlive the annotator.
  explicit LogAnnotator(std::ostream& stream) : stream_(stream), packer_(buffer_) {}

  /// Copies records as they are. Errors: `Error` when the stream fails.
  void copy(std::string_view records);

  /// Copies one record with `beliefs` added to its `observation`; `record` and `outline` as
  /// `LogReader` gives them.
  /// Errors: `InputError` if the record has no `observation` map; `Error` when the stream fails.
  void annotate(std::string_view record, const ObservationOutline& outline,
                const LogBeliefs& beliefs);

 private:
  std::ostream& stream_;
  msgpack::sbuffer buffer_;
  LogPacker packer_;
};

}  // namespace touchdown::recordings
