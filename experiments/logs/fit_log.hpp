#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "estimator/bayes/measurement_fit.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

/// A log to fit to.
struct FitLog {
  std::filesystem::path path;
  /// The one class that all of its steps have, as in the paper; without it the log's own ground
  /// truth tells.
  std::optional<bool> contact;
};

struct LogFitConfig {
  scoring::LabelConfig labels;  ///< of logs with ground truth
  double skip = 0.3;            ///< not used at the beginning of each log (s)
  /// Stops with `Stopped` once true; may be null.
  const std::atomic<bool>* stop = nullptr;
};

/// What a fit was made of; index 0 is no contact, 1 is contact.
struct LogFitReport {
  double seconds = 0.0;                ///< of all logs, without what was skipped
  std::array<std::size_t, 2> samples;  ///< of both legs
  std::array<TorqueBandwidth, 2> bandwidth;
  std::size_t unusable = 0;  ///< samples left out because they are not finite
  std::vector<std::string> warnings;
};

}  // namespace touchdown::experiments
