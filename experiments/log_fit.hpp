#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "estimator/bayes_filter.hpp"
#include "experiments/labels.hpp"
#include "recordings/phase_model_file.hpp"

namespace touchdown {

/// A log to fit to.
struct FitLog {
  std::filesystem::path path;
  /// The one class that all of its steps have, as in the paper; without it the log's own ground
  /// truth tells.
  std::optional<bool> contact;
};

struct LogFitConfig {
  LabelConfig labels;  ///< of logs with ground truth
  double skip = 0.3;   ///< not used at the beginning of each log (s)
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

/// `fit` (experiments/fitting.hpp) for logs, at a memory that does not grow with them: each is read
/// twice. A torque that is not finite is left out with its leg's step; after a gap in time, or a
/// step back, the torque's low-pass starts anew, as in the filter.
/// Errors: `InputError` for logs of reserved seeds, without ground truth where none is declared,
/// without one of the two classes, or unreadable; standard input cannot be read twice.
MeasurementModel fit_logs(std::span<const FitLog> logs, const BayesFilterConfig& filter,
                          const LogFitConfig& config, LogFitReport& report);

/// `fit_phases` for logs, which have to have ground truth and are held in memory (0.25 MB/s at
/// 1 kHz). Errors: `InputError` as above, and for values that are not finite, gaps in time, or logs
/// without a takeoff.
PhaseModelFile fit_phases_to_logs(std::span<const FitLog> logs, const LogFitConfig& config,
                                  LogFitReport& report);

}  // namespace touchdown
