#pragma once

#include <ostream>
#include <string_view>

#include "estimator/contact_estimator.hpp"
#include "recordings/log/packing.hpp"

namespace touchdown::recordings {

/// Copies a log record by record and writes beliefs into it, at a constant memory: by the names
/// under which the authors' contact_agent logs them, which filters one leg only (here the left
/// one), as `observation.measurement_model`, `.transition_model` and `.contact_filter`; and in the
/// last, what we know besides. NaN for what an estimator does not compute. Everything else in a
/// record stays as it was, byte for byte; beliefs that a record has already are replaced.
class LogAnnotator {
 public:
  /// `stream` must outlive the annotator.
  explicit LogAnnotator(std::ostream& stream) : stream_(stream), packer_(buffer_) {}

  /// Copies records as they are. Errors: `Error` when the stream fails.
  void copy(std::string_view records);

  /// Copies one record with what an estimator believes, and why, added to its `observation`;
  /// `record` as `LogReader` gives it.
  /// Errors: `InputError` if the record has no `observation` map; `Error` when the stream fails.
  void annotate(std::string_view record, const Belief& belief, const Evidence& evidence);

 private:
  std::ostream& stream_;
  msgpack::sbuffer buffer_;
  LogPacker packer_;
};

}  // namespace touchdown::recordings
