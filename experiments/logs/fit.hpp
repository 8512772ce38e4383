#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/estimators/entry.hpp"
#include "experiments/logs/log_steps.hpp"
#include "logs/log/contact_intervals.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

/// A log to fit to.
struct FitLog {
  std::filesystem::path path;
  /// The one class of all steps, as in the paper. Without it the log's own ground truth counts.
  std::optional<bool> contact = {};
  /// The log, if it is in memory; `path` is then only its name.
  std::shared_ptr<const logs::Recording> recording = {};
  /// Labels of segments of the log; steps between the segments are left out.
  std::shared_ptr<const logs::ContactIntervals> labels = {};
  /// Every second part of the log alone, of `part_length`: the even (0) or the odd ones (1).
  std::optional<int> part = {};
};
inline constexpr double part_length = 10.0;  // s

struct LogFitConfig {
  scoring::LabelConfig labels;  ///< of logs with ground truth
  double skip = 0.3;            ///< not used at the beginning of each log (s)
  /// Of the logs. Without legs, simulated logs have those of their own robots' files, others
  /// Upkie's.
  LogRobot robot = {};
  HyperparameterValues hyperparameters = {};  ///< replace the estimator's defaults
  bool shows_progress = false;                ///< on standard error, of large logs
  /// Stops with `Stopped` once true; may be null.
  const std::atomic<bool>* stop = nullptr;
};

/// The data of a fit; index 0 is no contact, 1 is contact.
struct LogFitReport {
  FittedTo fitted_to;                  ///< for the model's metadata and provenance
  std::array<std::size_t, 2> samples;  ///< of both legs
  std::array<TorqueBandwidth, 2> bandwidth;
  std::map<std::string, std::string> digests;  ///< of the logs, with their names
  std::size_t unusable = 0;                    ///< samples left out: beyond what a sensor measures
  /// Of logs with a declared class: the loads on wheels that the torques give.
  struct DeclaredLoad {
    double sum = 0.0;  ///< N
    double count = 0.0;

    void add(const DynamicLoads::Loads& loads) {
      for (const WheelLoad& wheel : loads) {
        if (!std::isfinite(wheel.force)) continue;
        sum += wheel.force;
        count += 1.0;
      }
    }
  };
  std::array<DeclaredLoad, 2> declared_load = {};
  std::vector<std::string> warnings;
};

/// Fits an estimator's measurement model to logs, as experiments do, and records their digests in
/// its provenance. Each log is read once; only the torques of both legs are held in memory (32 kB/s
/// at 1 kHz). A torque that is not finite, or beyond `SignalGuardConfig::largest_torque`, is left
/// out with its leg's step. After a gap in time, or a step back, the torque's low-pass restarts, as
/// in the filter. Errors: `InputError` for unknown hyperparameters, for logs without one of the two
/// classes, and for logs that are unreadable, of reserved seeds, without ground truth or a declared
/// class, with labels of other times, or copies of each other.
Model fit_to_logs(const EstimatorEntry& entry, std::span<const FitLog> logs,
                  const LogFitConfig& config, LogFitReport& report);

/// Whether a model was fitted to a log that was read to its end: to a copy of it, or to the same
/// run of the same scene.
bool was_fitted_to(const Model& model, const LogSteps& log);

/// Balanced accuracy of both wheels, as `touchdown estimate` prints it.
struct FitAccuracy {
  double fitted = 0.0;  ///< of the model on the logs that it was fitted to
  /// On what a model is not fitted to: on every log by a model of the others, where of more than
  /// five logs some are left out together. Where these lack a class, on every second part of all
  /// logs by a model of the other parts. Nothing if neither suffices.
  std::optional<double> held_out = {};
  bool by_parts = false;
  double load_filter = 0.0;  ///< of the filter of loads, without a fit, on the same steps
  /// The flights of a wheel that the filter of loads finds in logs declared in contact: one line
  /// per log with some.
  std::vector<std::string> flights = {};
};

/// Estimates the logs of a fit with its model, with models that are fitted again, and with the
/// filter of loads. Errors: as above.
FitAccuracy accuracy_of_fit(const EstimatorEntry& entry, std::span<const FitLog> logs,
                            const LogFitConfig& config, const Model& model);

}  // namespace touchdown::experiments
