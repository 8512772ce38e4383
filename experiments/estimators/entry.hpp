#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "estimator/bayes/config.hpp"
#include "estimator/contact_estimator.hpp"
#include "estimator/force/leg_geometry.hpp"
#include "estimator/phase/config.hpp"
#include "experiments/estimators/fit_runs.hpp"
#include "experiments/estimators/fitted_model.hpp"
#include "experiments/batch/noise_level.hpp"
#include "experiments/signals/estimator_runner.hpp"
#include "noise/sensor_noise.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

/// What an estimator is made for.
struct EstimatorSetup {
  double sample_rate = 1000.0;         ///< Hz
  const FittedModel* model = nullptr;  ///< for those that are fitted
  /// Of the robot that it will listen to, where its file is known: before what its model says.
  std::optional<LegGeometry> legs = {};
  /// The labels of the run that it will listen to, for the one that repeats them.
  const std::array<scoring::ContactSequence, models::wheel_count>* truth = nullptr;
};

/// Sensors whose noise can change what an estimator decides about the wheels.
struct Sensors {
  bool hip_torque = false;
  bool knee_torque = false;
  bool wheel_torque = false;
  bool acceleration = false;
  bool joint_position = false;
  bool joint_velocity = false;
};

/// The part of the noise that these sensors have; all else is zero. Levels with the same part need
/// to be listened to only once.
noise::SensorNoise noise_of(const Sensors& sensors, const noise::SensorNoise& levels);

/// An estimator under many noise levels side by side (experiments/batch), without a signal guard.
struct BatchedEstimator {
  std::function<void(const Signals& clean, const NoiseStep& draws)> update;
  /// Per level, in contact where it reaches the threshold.
  std::function<std::span<const double>(Side side)> p_contact;
  double threshold = 0.5;
};

/// A constant of an estimator that tuning may choose.
struct Hyperparameter {
  enum class Scale : int { even, by_ratio, whole };

  std::string name;    ///< as in the passports of its models, if it is there
  double value = 0.0;  ///< the default, or what was chosen
  double lowest = 0.0;
  double highest = 0.0;
  Scale scale = Scale::even;    ///< on which trials are drawn evenly between the two
  bool is_fitted_with = false;  ///< whether a model is another one with another value
};

/// Choices in one line: from `lowest` to `highest`; up to so many times more or less than the
/// default; whole numbers.
Hyperparameter between(std::string name, double value, double lowest, double highest);
Hyperparameter around(std::string name, double value, double factor);
Hyperparameter whole_between(std::string name, double value, double lowest, double highest);
/// One that decides about the model, too.
Hyperparameter fitted_with(Hyperparameter choice);

/// All that an experiment has to know about an estimator. Most have only some of it.
struct EstimatorEntry {
  std::string name;     ///< in experiment files
  std::string title;    ///< for tables and figures
  std::string summary;  ///< one line: what it does
  Sensors sensors;
  /// Whether it stands for what there is to be had, and not for what one would take.
  bool is_upper_bound = false;
  /// The configuration whose measurement model it needs, if it needs one.
  std::optional<BayesFilterConfig> config = {};
  /// The configuration whose phase model it needs, if it needs one.
  std::optional<PhaseFilterConfig> phase = {};
  /// How it is fitted, if it is: to one of the two above, or else to parameters of its own, which
  /// experiments/estimators/parameter_fitting.hpp makes a model of.
  FittedModel (*fit)(const EstimatorEntry& entry, const FitRuns& runs) = nullptr;
  /// Whether it is fitted to an experiment's pieces, too, if there are any.
  bool learns_from_segments = false;
  /// What made its model, if that is no part of an experiment.
  std::string trained_by = {};
  /// It is told the labels of the runs it listens to: nothing for logs without.
  bool needs_truth = false;
  /// What tuning may choose; empty: nothing.
  std::vector<Hyperparameter> hyperparameters = {};
  /// Puts the choices' values into `config` and `phase`, where they have their place there.
  void (*apply)(EstimatorEntry& entry) = nullptr;
  std::unique_ptr<ContactEstimator> (*make)(const EstimatorEntry& entry,
                                            const EstimatorSetup& setup) = nullptr;
  /// Null for an estimator without lanes; nothing where its lanes do not know noise of that kind.
  std::optional<BatchedEstimator> (*lanes)(const EstimatorEntry& entry, const EstimatorSetup& setup,
                                         std::span<const noise::SensorNoise> levels) = nullptr;
  /// Instead of `make`, for one that hears a whole run at once.
  std::function<WholeRunEstimator(const EstimatorSetup& setup)> whole_run = {};
  /// What decides about its numbers and is no part of the program: saved under another one they do
  /// not count.
  std::string revision = {};

  /// Which kind of model it is fitted with, if it is.
  std::optional<ModelKind> fits() const {
    if (config) return ModelKind::measurement;
    if (phase) return ModelKind::phase;
    return fit != nullptr ? std::optional(ModelKind::parameters) : std::nullopt;
  }
  /// The value of one of the choices.
  double chosen(std::string_view choice) const;
};

/// The same estimator with constants that were chosen. Names that are none of its choices do not
/// count.
EstimatorEntry with_hyperparameters(EstimatorEntry entry, const HyperparameterValues& hyperparameters);

/// Errors: `InputError`, one line with the nearest name, for one that is none of its choices.
void check_names(const HyperparameterValues& hyperparameters, const EstimatorEntry& entry);

/// The estimator, however it listens, made for this.
EstimatorRunner runner_of(const EstimatorEntry& entry, const EstimatorSetup& setup);

/// Whether one fit serves both.
bool share_model(const EstimatorEntry& one, const EstimatorEntry& other);

}  // namespace touchdown::experiments
