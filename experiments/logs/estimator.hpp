#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "estimator/contact_estimator.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// An estimator for logs: which one, and what it was fitted with.
struct LogEstimator {
  EstimatorEntry entry;
  FittedModel model;

  /// At the log's rate (Hz). The window of a transition model lasts as long as at 1 kHz.
  /// Errors: `InputError` for a rate that the estimator cannot be run at.
  std::unique_ptr<ContactEstimator> make(double sample_rate) const;
};

/// The estimator of this name with the model in this file; empty where nothing was said: the name
/// then follows from the model (`phase`, `robust`, or who the parameters belong to). Errors:
/// `InputError` for an unknown name (with the nearest one), a model that is missing, not needed,
/// another estimator's or unreadable, and for an estimator that does not listen to logs.
LogEstimator log_estimator(const std::string& name, const std::filesystem::path& model);

}  // namespace touchdown::experiments
