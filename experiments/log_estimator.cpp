#include "experiments/log_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.hpp"
#include "estimator/bayes_filter.hpp"
#include "estimator/measurement_only.hpp"
#include "recordings/model_file.hpp"
#include "recordings/npz.hpp"

namespace touchdown {

namespace {

bool holds_phases(const std::filesystem::path& path) {
  return read_npz(path).contains("transition");
}

void check_model_is(const EstimatorEntry& entry, const std::filesystem::path& path) {
  const bool phases = holds_phases(path);
  if (phases == entry.phase.has_value()) return;
  throw InputError(fmt::format("{}: is {}, which '{}' cannot use (did you mean --estimator {}?)",
                               path.string(), phases ? "a phase model" : "no phase model",
                               entry.name, phases ? "phase" : "robust"));
}

FittedModel read_model(const EstimatorEntry& entry, const std::filesystem::path& path) {
  FittedModel model;
  if (!entry.config && !entry.phase) {
    if (!path.empty()) {
      throw InputError(fmt::format("--model: '{}' is not fitted and takes none", entry.name));
    }
    return model;
  }
  if (path.empty()) {
    throw InputError(fmt::format(
        "--model is missing: '{0}' has to be fitted: touchdown fit LOG --estimator {0} -o "
        "model.npz",
        entry.name));
  }
  check_model_is(entry, path);
  if (entry.config) model.measurement = read_measurement_model(path);
  if (entry.phase) model.phase = std::make_shared<const PhaseModelFile>(read_phase_model(path));
  return model;
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

void add_measurement(LogBeliefs& beliefs, const MeasurementDiagnostics& measurement) {
  beliefs.contact_likelihood = measurement.likelihood.contact;
  beliefs.no_contact_likelihood = measurement.likelihood.no_contact;
  beliefs.measurement_p_contact = measurement.p_measurement();
}

void add_transition(LogBeliefs& beliefs, const Transition& transition) {
  beliefs.power = transition.power;
  beliefs.median_frequency = transition.median_frequency;
  beliefs.filtered_median_frequency = transition.filtered_median_frequency;
  beliefs.p_switch = transition.p_switch;
  beliefs.p_landing = transition.p_landing;
  beliefs.p_landing_p_switch = transition.air_to_contact;
  beliefs.p_takeoff_p_switch = transition.contact_to_air;
}

}  // namespace

std::unique_ptr<ContactEstimator> LogEstimator::make(double sample_rate) const {
  EstimatorEntry at_rate = entry;
  if (at_rate.config) {
    const BayesFilterConfig& usual = *entry.config;
    at_rate.config->transition.window = std::max(
        2,
        static_cast<int>(std::lround(usual.transition.window * sample_rate / usual.sample_rate)));
  }
  return at_rate.make(at_rate, &model, sample_rate);
}

LogEstimator log_estimator(const std::string& name, const std::filesystem::path& model) {
  std::string chosen = name;
  if (chosen.empty()) chosen = !model.empty() && holds_phases(model) ? "phase" : "robust";
  const EstimatorEntry& entry = estimator_entry(chosen);
  if (entry.name == "oracle") {
    throw InputError(
        "--estimator: the oracle repeats the ground truth, it does not listen to logs");
  }
  return {entry, read_model(entry, model)};
}

LogBeliefs log_beliefs(const ContactEstimator& estimator, const Belief& belief) {
  LogBeliefs beliefs{unknown, unknown, unknown, unknown, unknown, unknown, unknown, unknown,
                     unknown, unknown, unknown, unknown, {},      unknown, unknown, {}};
  if (const auto* filter = dynamic_cast<const BayesFilter*>(&estimator)) {
    add_measurement(beliefs, filter->measurement(Side::left));
    add_transition(beliefs, filter->transition());
  } else if (const auto* only = dynamic_cast<const MeasurementOnly*>(&estimator)) {
    add_measurement(beliefs, only->measurement(Side::left));
  }
  beliefs.p_contact = belief.wheel[0].p_contact;
  beliefs.wheel = belief.wheel;
  beliefs.p_any_wheel = belief.p_any_wheel;
  beliefs.p_both_wheels = belief.p_both_wheels;
  beliefs.status = belief.status;
  return beliefs;
}

}  // namespace touchdown
