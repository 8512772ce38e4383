#include "experiments/logs/phase_fit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/fitting/phase_fitting.hpp"
#include "experiments/logs/listener.hpp"
#include "scoring/label_stream.hpp"

namespace touchdown::experiments {

namespace {

bool finite(const Signals& signals) {
  double sum = signals.vertical_acceleration;
  for (const LegSignals& leg : signals.leg) sum += leg.knee.torque + leg.wheel.torque;
  return std::isfinite(sum);
}

void check_step(const FitLog& log, const LogStep& step, double before) {
  const auto refuse = [&](std::string_view what) {
    throw InputError(
        fmt::format("{}: at {:.3f} s: {}", log.path.string(), step.signals.time, what));
  };
  if (!step.normal_force) {
    refuse("no ground truth of contact, which the phase filter has to be fitted with");
  }
  if (!finite(step.signals)) refuse("a torque or the acceleration is not finite");
  const double elapsed = step.signals.time - before;
  if (elapsed < 0.0 || elapsed > SignalGuardConfig{}.maximum_gap) {
    refuse("time jumps: the phase filter has to be fitted to logs without gaps");
  }
}

RunSignals signals_of_log(const FitLog& log, const LogFitConfig& config, LogFitReport& report) {
  recordings::LogReader reader(log.path, config.stop);
  LogListener listener(reader);
  RunSignals run;
  run.info = reader.info();
  run.info.control_period_us = listener.period_us();
  const auto labels_of = [&](std::size_t wheel) {
    return scoring::LabelStream(
        listener.period(), config.labels,
        [&run, wheel](std::uint8_t contact) { run.contact[wheel].push_back(contact); });
  };
  std::array<scoring::LabelStream, models::wheel_count> labels = {labels_of(0), labels_of(1)};
  while (const LogStep* step = listener.next()) {
    check_step(log, *step, run.signals.empty() ? NAN : run.signals.back().time);
    for (std::size_t wheel = 0; wheel < labels.size(); ++wheel) {
      labels[wheel].add((*step->normal_force)[wheel]);
      run.normal_force[wheel].push_back((*step->normal_force)[wheel]);
    }
    run.signals.push_back(step->signals);
  }
  if (config.stop != nullptr && *config.stop) throw Stopped("stopped; no model was written");
  for (scoring::LabelStream& of_wheel : labels) of_wheel.finish();
  report.warnings.insert(report.warnings.end(), reader.warnings().begin(), reader.warnings().end());
  return run;
}

/// Whether both wheels leave the ground together somewhere in what is used of the run.
bool has_takeoff(const RunSignals& run, std::size_t skipped) {
  const scoring::ContactSequence any = scoring::any_wheel(run.contact);
  const std::vector<scoring::Flight> all = scoring::flights(any);
  return std::any_of(all.begin(), all.end(),
                     [&](const scoring::Flight& flight) { return flight.takeoff > skipped; });
}

}  // namespace

recordings::PhaseModelFile fit_phases_to_logs(std::span<const FitLog> logs,
                                              const PhaseFitConfig& phases,
                                              const LogFitConfig& config, LogFitReport& report) {
  report = {};
  std::vector<RunSignals> runs;
  bool takeoff = false;
  for (const FitLog& log : logs) {
    if (log.contact) {
      throw InputError(fmt::format(
          "{}: the phase filter learns how wheels leave the ground and land: it has to be fitted "
          "to logs with ground truth, not to --contact and --no-contact",
          log.path.string()));
    }
    runs.push_back(signals_of_log(log, config, report));
    const RunSignals& run = runs.back();
    const double period = 1e-6 * static_cast<double>(run.info.control_period_us);
    const auto skipped = static_cast<std::size_t>(std::llround(config.skip / period));
    takeoff = takeoff || has_takeoff(run, skipped);
    const std::size_t used = run.steps() - std::min(run.steps(), skipped);
    report.seconds += static_cast<double>(used) * period;
    for (const scoring::ContactSequence& contact : run.contact) {
      for (std::size_t k = skipped; k < contact.size(); ++k) ++report.samples[contact[k] & 1U];
    }
  }
  if (!takeoff) {
    throw InputError("fit: the phase filter learns from takeoffs, and the logs hold none");
  }
  std::vector<const RunSignals*> fitted;
  for (const RunSignals& run : runs) fitted.push_back(&run);
  return fit_phases(fitted, phases, config.skip);
}

}  // namespace touchdown::experiments
