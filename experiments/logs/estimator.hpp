#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "estimator/contact_estimator.hpp"
#include "experiments/estimators/entry.hpp"
#include "experiments/logs/robot.hpp"
#include "recordings/recording.hpp"

namespace touchdown::experiments {

/// Which estimator listens to logs, with which model.
struct LogEstimatorRequest {
  std::string name = {};             ///< empty: as the model says
  std::filesystem::path model = {};  ///< empty: none
  LogRobot robot = {};               ///< whose logs they are; its legs before the model's
  /// At other rates and on other robots than it was fitted for, too.
  bool transfer = false;
  HyperparameterValues hyperparameters = {};  ///< instead of the model's; of those that its fit did not need
};

/// An estimator for logs: which one, and what it was fitted with.
struct LogEstimator {
  EstimatorEntry entry;
  FittedModel model;
  LogEstimatorRequest request;

  /// At a log's rate (Hz). The window of a transition model lasts as long as at 1 kHz. Errors:
  /// `InputError` for a rate that the estimator cannot be run at, and for a rate or a robot that
  /// its model was not fitted for, unless that was asked for.
  std::unique_ptr<ContactEstimator> make(double sample_rate,
                                         const recordings::RecordingInfo& log = {}) const;

  /// What the model says about itself, in a line; empty without a model.
  std::string model_text() const;
};

/// The model may be one of the project's own (core/resources.hpp), wherever the program is called.
/// Whose it is, if no name is given: as its passport or its parameters say, or else `phase`
/// for a phase model, `robust` for a grid. Errors: `InputError` for an unknown name (with the
/// nearest one), a model that is missing, not needed, another estimator's or unreadable, and for an
/// estimator that does not listen to logs.
LogEstimator log_estimator(LogEstimatorRequest request);

}  // namespace touchdown::experiments
