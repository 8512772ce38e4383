#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "estimator/contact_estimator.hpp"
#include "experiments/estimators/entry.hpp"
#include "experiments/logs/log_steps.hpp"
#include "logs/recording.hpp"

namespace touchdown::experiments {

/// The estimator that runs on logs if none is named: it needs the robot alone.
inline constexpr const char* default_estimator = "load_filter";

/// An estimator to run on logs, and its model.
struct LogEstimatorRequest {
  std::string name = {};             ///< empty: the model's; without a model, `default_estimator`
  std::filesystem::path model = {};  ///< empty: none
  /// Robot of the logs. Without its legs the load filter uses the model's, else those of a
  /// simulated log's own robot.
  LogRobot robot = {};
  bool transfer = false;  ///< allows another robot than the model was fitted for
  HyperparameterValues hyperparameters = {};  ///< replace the model's; none that the fit uses
};

/// An estimator for logs, with its fitted model.
struct LogEstimator {
  EstimatorEntry entry;
  Model model;
  LogEstimatorRequest request;

  /// The estimator at a log's rate (Hz), or at the model's where both are equal to 1 %. The window
  /// of a transition model keeps its duration at 1 kHz. Errors: `InputError` for a rate at which
  /// the estimator cannot run or that the model was not fitted for. Without `request.transfer` also
  /// for a robot that it was not fitted for.
  std::unique_ptr<ContactEstimator> make(double sample_rate,
                                         const logs::RecordingInfo& log = {}) const;

  /// The model's metadata in one line; empty without a model.
  std::string model_text() const;
};

/// Makes the estimator of a request. The model may be one of the project's own
/// (core/resources.hpp). Without a name, the model's metadata name the estimator; else it is
/// `robust`. Errors: `InputError` for an
/// unknown name (with the nearest one); for a model that is missing, not needed, unreadable or of
/// another estimator; for an estimator that does not run on logs.
LogEstimator log_estimator(LogEstimatorRequest request);

/// The estimator of a model that was fitted for it, for any robot.
LogEstimator log_estimator(const EstimatorEntry& entry, Model model, const LogRobot& robot);

}  // namespace touchdown::experiments
