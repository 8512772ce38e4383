#pragma once

#include <filesystem>
#include <pybind11/pybind11.h>
#include <string>

#include "experiments/logs/estimator.hpp"
#include "experiments/logs/fit.hpp"

namespace touchdown::python {

/// A fitted model with its estimator, and a report of the fit.
struct Model {
  experiments::LogEstimator estimator;
  experiments::LogFitReport report = {};

  static Model load(const std::filesystem::path& path, const std::string& estimator);
  void save(const std::filesystem::path& path) const;
};

/// The model's estimator, or another one that can use the model. `request` has the name, the robot
/// and whether transfer is allowed. Errors: `InputError` for an estimator that cannot.
experiments::LogEstimator with_model(experiments::LogEstimatorRequest request, const Model& model);

/// Adds `Model` and `fit`.
void add_models(pybind11::module_& module);

/// Adds estimators by name, step by step and over whole runs. Their models come before.
void add_estimators(pybind11::module_& module);

/// Adds functions that run experiments.
void add_experiments(pybind11::module_& module);

/// Adds functions that simulate, read, write and check runs, label contact and score beliefs.
void add_runs(pybind11::module_& module);

}  // namespace touchdown::python
