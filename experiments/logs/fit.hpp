#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/estimators/entry.hpp"
#include "experiments/logs/robot.hpp"
#include "recordings/beliefs/contact_intervals.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

/// A log to fit to.
struct FitLog {
  std::filesystem::path path;
  /// The one class that all of its steps have, as in the paper; without it the log's own ground
  /// truth tells.
  std::optional<bool> contact = {};
  /// Its records, if they are at hand; then the path is but their name.
  std::shared_ptr<const std::string> records = {};
  /// Somebody says it, for stretches of the log; what lies between them is left out.
  std::shared_ptr<const recordings::ContactIntervals> labels = {};
};

struct LogFitConfig {
  scoring::LabelConfig labels;  ///< of logs with ground truth
  double skip = 0.3;            ///< not used at the beginning of each log (s)
  LogRobot robot = {};          ///< whose logs they are; without legs: Upkie's
  HyperparameterValues hyperparameters = {};     ///< of the estimator, instead of its defaults
  /// Stops with `Stopped` once true; may be null.
  const std::atomic<bool>* stop = nullptr;
};

/// What a fit was made of; index 0 is no contact, 1 is contact.
struct LogFitReport {
  double seconds = 0.0;                ///< of all logs, without what was skipped
  FittedTo fitted_to;                  ///< for the model's passport
  std::array<std::size_t, 2> samples;  ///< of both legs
  std::array<TorqueBandwidth, 2> bandwidth;
  std::size_t unusable = 0;  ///< samples left out because no sensor measures them
  std::vector<std::string> warnings;
};

/// The model that an estimator needs, fitted to logs. Errors: `InputError` for constants that it
/// does not have, for logs of reserved seeds, without ground truth where none is declared, with
/// labels about other times, or unreadable.
///
/// A measurement model is fitted as in experiments/fitting, at a memory that does not grow with the
/// logs: each is read twice, which standard input cannot be. A torque that is not finite, or
/// beyond `SignalGuardConfig::largest_torque`, is left out with its leg's step; after a gap in
/// time, or a step back, the torque's low-pass starts anew, as in the filter. Errors: `InputError`
/// for logs without one of the two classes.
///
/// A phase model is fitted to logs with ground truth, held in memory (0.25 MB/s at 1 kHz). Errors:
/// `InputError` for values that are not finite, gaps in time, or logs without a takeoff.
///
/// Parameters are fitted to logs in memory, too, of one class or with ground truth; what cannot be
/// used is left out as when listening. Errors: `InputError` for logs without one of the classes.
FittedModel fit_to_logs(const EstimatorEntry& entry, std::span<const FitLog> logs,
                        const LogFitConfig& config, LogFitReport& report);

}  // namespace touchdown::experiments
