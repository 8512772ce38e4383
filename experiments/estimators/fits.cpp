#include "experiments/estimators/fits.hpp"

#include <vector>

#include "estimator/bayes/measurement_fit.hpp"
#include "experiments/signals/run_signals.hpp"
#include "scoring/score.hpp"

namespace touchdown::experiments {

MeasurementModel fit_torques(const FitRuns& runs, const MeasurementConfig& config) {
  std::vector<TorqueSample> contact;
  std::vector<TorqueSample> no_contact;
  for (const RunSignals* run : runs.whole) {
    const double period = run->period();
    const std::size_t skip = scoring::first_scored_step(run->info.control_period_us, runs.scoring);
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

}  // namespace touchdown::experiments
