#pragma once

#include <array>
#include <ostream>
#include <string_view>

#include "estimator/contact_estimator.hpp"
#include "logs/log/packing.hpp"

namespace touchdown::logs {

/// The keys of `observation` under which beliefs are logged.
inline constexpr std::array<std::string_view, 3> belief_groups = {
    "measurement_model", "transition_model", "contact_filter"};

/// Copies a log record by record and adds beliefs, with constant memory. The keys are those of the
/// authors' contact_agent: `observation.measurement_model`, `.transition_model` and
/// `.contact_filter`. As contact_agent filters one leg only, they describe the left leg; the other
/// values are extra keys of `.contact_filter`. Values that an estimator does not compute are NaN.
/// Existing beliefs are replaced. The rest of a record is copied byte for byte.
class LogAnnotator {
 public:
  /// `stream` must outlive the annotator.
  explicit LogAnnotator(std::ostream& stream) : stream_(stream), packer_(buffer_) {}

  /// Copies records unchanged. Errors: `Error` when the stream fails.
  void copy(std::string_view records);

  /// Copies one record of `LogReader` and adds an estimator's belief and evidence to its
  /// `observation`.
  /// Errors: `InputError` if the record has no `observation` map; `Error` when the stream fails.
  void annotate(std::string_view record, const Belief& belief, const Evidence& evidence);

 private:
  std::ostream& stream_;
  msgpack::sbuffer buffer_;
  LogPacker packer_;
};

}  // namespace touchdown::logs
