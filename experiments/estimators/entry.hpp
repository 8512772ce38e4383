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
#include "experiments/batch/noise_level.hpp"
#include "experiments/estimators/fits.hpp"
#include "experiments/estimators/fitted_model.hpp"
#include "experiments/signals/estimator_runner.hpp"
#include "noise/sensor_noise.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

/// The robot and the run that an estimator is made for.
struct EstimatorSetup {
  double sample_rate = 1000.0;   ///< Hz
  const Model* model = nullptr;  ///< for estimators with a fitted model
  /// Legs of the robot, if its file is known. They take precedence over those in the model.
  std::optional<LegGeometry> legs = {};
  /// The labels of the run, for the oracle.
  const std::array<scoring::ContactSequence, models::wheel_count>* truth = nullptr;
  /// The entry's `configured_rate`, if windows keep their duration at this sample rate. Zero: they
  /// keep their number of steps.
  double configured_rate = 0.0;
};

/// Sensors with noise that can change an estimator's decisions about the wheels.
struct Sensors {
  bool hip_torque = false;
  bool knee_torque = false;
  bool wheel_torque = false;
  bool acceleration = false;
  bool joint_position = false;
  bool joint_velocity = false;
};
inline constexpr Sensors all_sensors = {true, true, true, true, true, true};

/// The part of the noise that these sensors have; all else is zero. An estimator is evaluated only
/// once for levels with the same part.
noise::SensorNoise noise_of(const Sensors& sensors, const noise::SensorNoise& levels);

/// An estimator for many noise levels at once (experiments/batch), without a signal guard.
struct BatchedEstimator {
  std::function<void(const Signals& clean, const NoiseStep& draws)> update;
  /// Per noise level. A wheel is in contact where the value reaches the threshold.
  std::function<std::span<const double>(Side side)> p_contact;
  double threshold = 0.5;
};

/// A constant of an estimator that tuning can choose.
struct Hyperparameter {
  enum class Scale : int { even, by_ratio, whole };

  std::string name;    ///< as in the metadata of models, if they have it
  double value = 0.0;  ///< the default, or the chosen value
  double lowest = 0.0;
  double highest = 0.0;
  Scale scale = Scale::even;    ///< on which trials are uniform in this range
  bool is_fitted_with = false;  ///< whether the fitted model depends on it
};

/// Short constructors: from `lowest` to `highest`; up to `factor` times more or less than the
/// default; whole numbers from `lowest` to `highest`.
Hyperparameter between(std::string name, double value, double lowest, double highest);
Hyperparameter around(std::string name, double value, double factor);
Hyperparameter whole_between(std::string name, double value, double lowest, double highest);
/// Marks a hyperparameter that the fitted model depends on.
Hyperparameter fitted_with(Hyperparameter hyperparameter);

/// What an estimator is given about the robot, beside the signals of its sensors.
struct RobotKnowledge {
  bool geometry = false;  ///< lengths and masses of its legs
  bool mass = false;      ///< its whole mass
  bool targets = false;   ///< targets and gains of its joints, if there are any
  bool truth = false;     ///< labels, so that it cannot run on logs without them
};

struct EstimatorEntry;

/// How a model of the estimator is fitted.
struct FitMethod {
  /// Null for an estimator that experiments do not fit.
  Model (*fit)(const EstimatorEntry& entry, FitRuns runs, double skip) = nullptr;
  /// The program that trained its model, if experiments do not fit it.
  std::string trained_by = {};
  std::optional<MeasurementConfig> torques = {};  ///< settings of the densities that it fits
};

/// How the estimator is made for a run: step by step as on a robot, or for the whole run at once.
struct MakeMethod {
  /// The model that comes with the program, for `find_program_file`; empty for other estimators.
  std::string model_file = {};
  std::unique_ptr<ContactEstimator> (*by_step)(const EstimatorEntry& entry,
                                               const EstimatorSetup& setup) = nullptr;
  /// Replaces `by_step`.
  std::function<WholeRunEstimator(const EstimatorSetup& setup)> whole_run = {};
};

/// Makes the estimator's batched form, which experiments/batch computes; null without one. Returns
/// nothing if that does not support such noise.
using BatchMethod = std::optional<BatchedEstimator> (*)(const EstimatorEntry& entry,
                                                        const EstimatorSetup& setup,
                                                        std::span<const noise::SensorNoise> levels);

/// An estimator in experiments: what it is and needs, its settings, and what can be done with it.
struct EstimatorEntry {
  std::string name;     ///< in experiment files
  std::string title;    ///< for tables and figures
  std::string summary;  ///< one sentence: what it does
  std::string reason;   ///< a phrase: on which axis one would prefer it to all others
  Sensors sensors;
  RobotKnowledge knows = {};
  /// Identifies code outside the program that its results depend on. Results saved with another
  /// revision are not reused.
  std::string revision = {};
  /// What tuning can choose; may be empty.
  std::vector<Hyperparameter> hyperparameters = {};
  /// Its settings, with the keys of a model's metadata. Those that it lacks are the model's, else
  /// the library's defaults.
  ConfigurationText configuration = {};
  double configured_rate = 1000.0;  ///< at which windows in it count steps (Hz)

  FitMethod fitting = {};
  MakeMethod making = {};
  BatchMethod batching = nullptr;

  /// Whether experiments fit a model of it.
  bool fits() const { return fitting.fit != nullptr; }
  /// Fits its model, still without metadata, to runs without their first `skip` seconds. Errors:
  /// `InputError` for runs of reserved seeds; those of its function.
  Model fit(FitRuns runs, double skip) const;
  /// Makes it step by step. Errors: `InputError` for an estimator that processes whole runs only;
  /// the errors of its library class.
  std::unique_ptr<ContactEstimator> make(const EstimatorSetup& setup) const;
  /// Makes a runner, which processes steps or whole runs.
  EstimatorRunner runner(const EstimatorSetup& setup) const;
  /// The value of one of its hyperparameters. Errors: `Error` for an unknown name.
  double chosen(std::string_view hyperparameter) const;
};

/// The same estimator with chosen values. Ignores names that are none of its hyperparameters.
EstimatorEntry with_hyperparameters(EstimatorEntry entry, const HyperparameterValues& values);

/// Errors: `InputError`, one line with the nearest name, for a name that the estimator does not
/// have.
void check_names(const HyperparameterValues& values, const EstimatorEntry& entry);
/// Errors: `InputError` for a number that the estimator's configuration cannot have.
void check_values(const HyperparameterValues& values, const EstimatorEntry& entry);

/// The `make` of an estimator that the library makes of its model.
std::unique_ptr<ContactEstimator> make_of_model(const EstimatorEntry& entry,
                                                const EstimatorSetup& setup);

/// What the estimator is given: "geometry, mass, targets". "signals; fitted" if it is given nothing
/// else and has a model.
std::string given_text(const EstimatorEntry& entry);

/// Whether both estimators use the same fit.
bool share_model(const EstimatorEntry& one, const EstimatorEntry& other);

}  // namespace touchdown::experiments
