#include "experiments/estimators/fits.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <list>
#include <vector>

#include "core/error.hpp"
#include "core/yaml.hpp"
#include "estimator/bayes/measurement_fit.hpp"
#include "estimator/signal_bounds.hpp"
#include "estimator/signal_guard.hpp"
#include "experiments/estimators/fit_runs.hpp"
#include "scoring/score.hpp"

namespace touchdown::experiments {

namespace {

/// Whether the step has all signals that a fit uses.
bool is_whole(const Signals& step) {
  return std::isfinite(step.vertical_acceleration) && has_torques(step.leg[0]) &&
         has_torques(step.leg[1]);
}

/// The signals with all values that a fit uses finite: a missing value repeats the previous one.
std::vector<Signals> without_gaps(std::vector<Signals> filled) {
  const auto fill = [&](const auto& value_of) {
    double last = 0.0;
    for (Signals& step : filled) {
      double& value = value_of(step);
      if (!std::isfinite(value)) value = last;
      last = value;
    }
  };
  fill([](Signals& step) -> double& { return step.vertical_acceleration; });
  for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
    fill([&](Signals& step) -> double& { return step.leg[leg].knee.torque; });
    fill([&](Signals& step) -> double& { return step.leg[leg].wheel.torque; });
  }
  return filled;
}

/// The run's signals as an estimator gets them: NaN in place of values beyond their bounds. Runs
/// without such values are not copied.
std::span<const Signals> usable_signals(const RunSignals& run,
                                        std::deque<std::vector<Signals>>& copies) {
  const SignalCheck check;
  const bool is_usable = std::all_of(
      run.signals.begin(), run.signals.end(),
      [&](const Signals& step) { return check.first_unusable(step) == SignalIndex::none; });
  if (is_usable) return run.signals;
  std::vector<Signals>& copy = copies.emplace_back(run.signals);
  for (Signals& step : copy) step = check.without_unusable(step);
  return copy;
}

}  // namespace

bool may_be_held(const logs::RecordingInfo& info) {
  if (info.scenario_yaml.empty()) return false;
  const YAML::Node scenario =
      YamlDocument::parse(info.scenario_yaml, info.scenario + " (in the log)").root();
  return std::any_of(scenario.begin(), scenario.end(), [](const auto& entry) {
    const auto key = entry.first.template as<std::string>();
    return key == "tether" || key == "forces";
  });
}

Model fit_phases(std::span<const RunSignals* const> runs, const PhaseFitConfig& config, double skip,
                 const std::function<void()>& before_density) {
  if (runs.empty()) throw InputError("phase filter: there is no run to fit to");
  std::vector<PhaseFitRun> segments;
  std::list<std::vector<Signals>> filled_runs;
  for (const RunSignals* run : runs) {
    if (run->info.control_period_us != runs.front()->info.control_period_us) {
      throw InputError("phase filter: fitted runs must share one control period");
    }
    const bool has_gaps = !std::all_of(run->signals.begin(), run->signals.end(), is_whole);
    if (has_gaps) filled_runs.push_back(without_gaps(run->signals));
    segments.push_back({has_gaps ? filled_runs.back() : run->signals,
                        {WheelContact(run->contact[0]), WheelContact(run->contact[1])},
                        may_be_held(run->info),
                        {run->normal_force[0], run->normal_force[1]},
                        skipped_steps(*run, skip)});
  }
  return {.arrays = {{std::string(provenance_array), provenance_of("phase", runs, skip)}},
          .phase = std::make_shared<const PhaseModel>(
              fit_phase_model(segments, 1.0 / runs.front()->period(), config, before_density))};
}

MeasurementModel fit(std::span<const RunSignals* const> runs, const MeasurementConfig& config,
                     const scoring::ScoringConfig& scoring) {
  std::vector<TorqueSample> contact;
  std::vector<TorqueSample> no_contact;
  for (const RunSignals* run : runs) {
    const double period = run->period();
    const std::size_t skip = scoring::first_scored_step(run->info.control_period_us, scoring);
    for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
      // Torques are processed as in the filter, and sorted by their wheel's label.
      TorqueChannel channel(config.torque, static_cast<Side>(leg), 1.0 / period);
      for (std::size_t k = 0; k < run->steps(); ++k) {
        if (!has_torques(run->signals[k].leg[leg])) continue;  // the filter ignores these, too
        const TorqueSample sample = channel.update(run->signals[k].leg[leg]);
        if (k >= skip) (run->contact[leg][k] != 0 ? contact : no_contact).push_back(sample);
      }
    }
  }
  return fit_measurement_model(contact, no_contact, config.fit);
}

Model fit_parameters(const EstimatorEntry& entry, const FitRuns& runs, const FitParameters& fit) {
  std::vector<LabelledRun> labelled;
  std::deque<std::vector<Signals>> copies;
  for (const RunSignals* run : runs.whole) {
    labelled.push_back({.signals = usable_signals(*run, copies),
                        .contact = {run->contact[0], run->contact[1]},
                        .sample_rate = 1.0 / run->period(),
                        .skip = skipped_steps(*run, runs.scoring.skip),
                        .legs = run->legs});
  }
  Model model{.arrays = arrays_of(fit(labelled), entry.name)};
  model.arrays[std::string(provenance_array)] =
      provenance_of(entry.name, runs.whole, runs.scoring.skip);
  return model;
}

}  // namespace touchdown::experiments
