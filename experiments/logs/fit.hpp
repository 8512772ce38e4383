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
  /// The one class of all steps, as in the paper. Without it the log's own ground truth counts.
  std::optional<bool> contact = {};
  /// Its records, if they are in memory; `path` is then only their name.
  std::shared_ptr<const std::string> records = {};
  /// Labels of segments of the log; steps between the segments are left out.
  std::shared_ptr<const recordings::ContactIntervals> labels = {};
};

struct LogFitConfig {
  scoring::LabelConfig labels;                ///< of logs with ground truth
  double skip = 0.3;                          ///< not used at the beginning of each log (s)
  LogRobot robot = {};                        ///< of the logs; without legs: Upkie's
  HyperparameterValues hyperparameters = {};  ///< replace the estimator's defaults
  /// Stops with `Stopped` once true; may be null.
  const std::atomic<bool>* stop = nullptr;
};

/// The data of a fit; index 0 is no contact, 1 is contact.
struct LogFitReport {
  double seconds = 0.0;                ///< of all logs, without skipped parts
  FittedTo fitted_to;                  ///< for the model's metadata
  std::array<std::size_t, 2> samples;  ///< of both legs
  std::array<TorqueBandwidth, 2> bandwidth;
  std::size_t unusable = 0;  ///< samples left out: beyond what a sensor measures
  std::vector<std::string> warnings;
};

/// Fits an estimator's model to logs. Errors: `InputError` for unknown hyperparameters, and for
/// logs that are unreadable, of reserved seeds, without ground truth or a declared class, or with
/// labels of other times.
///
/// A measurement model is fitted as in experiments/fitting. Memory does not grow with the logs:
/// each is read twice, so standard input is refused. A torque that is not finite, or beyond
/// `SignalGuardConfig::largest_torque`, is left out with its leg's step. After a gap in time, or a
/// step back, the torque's low-pass restarts, as in the filter. Errors: `InputError` for logs
/// without one of the two classes.
///
/// A phase model is fitted to logs with ground truth, held in memory (0.25 MB/s at 1 kHz). Errors:
/// `InputError` for values that are not finite, gaps in time, or logs without a takeoff.
///
/// Parameters are fitted to logs in memory, of one class or with ground truth. Unusable steps are
/// left out as during estimation. Errors: `InputError` for logs without one of the classes.
FittedModel fit_to_logs(const EstimatorEntry& entry, std::span<const FitLog> logs,
                        const LogFitConfig& config, LogFitReport& report);

}  // namespace touchdown::experiments
