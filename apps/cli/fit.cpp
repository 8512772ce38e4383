#include "experiments/logs/fit.hpp"

#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/cli/verb.hpp"
#include "core/error.hpp"
#include "core/program.hpp"
#include "core/progress.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/results/captions.hpp"
#include "logs/model_file.hpp"

namespace touchdown::cli {

namespace {

struct FitFlags {
  std::vector<std::string> logs;
  std::vector<std::string> contact;
  std::vector<std::string> no_contact;
  std::vector<std::string> labels;
  std::string output;
  std::string estimator = "robust";
  std::vector<std::string> hyperparameters;
  experiments::LogFitConfig config;
  std::string robot;
  bool skips_accuracy = false;
  std::vector<int> grid;
  std::vector<double> bandwidth;
  std::vector<double> bandwidth_floor;
  std::vector<double> knee_range;
  std::vector<double> wheel_range;
};

TorqueBandwidth bandwidth_from(const std::vector<double>& values, const char* flag) {
  if (!(values[0] >= 0.0 && values[1] >= 0.0)) {
    throw InputError(fmt::format("{}: expected two widths that are not negative (N·m)", flag));
  }
  return {values[0], values[1]};
}

std::pair<double, double> range_from(const std::vector<double>& values, const char* flag) {
  if (!(values[0] < values[1])) {
    throw InputError(fmt::format("{}: expected a lower and a higher torque (N·m)", flag));
  }
  return {values[0], values[1]};
}

/// Errors: `InputError` for a log that is named twice: it would count twice, or be both classes.
void require_different(const std::vector<experiments::FitLog>& logs) {
  for (std::size_t i = 0; i < logs.size(); ++i) {
    for (std::size_t j = i + 1; j < logs.size(); ++j) {
      std::error_code error;
      const bool is_same = logs[i].path == logs[j].path ||
                           std::filesystem::equivalent(logs[i].path, logs[j].path, error);
      if (!is_same) continue;
      throw InputError(
          logs[i].contact != logs[j].contact
              ? fmt::format("fit: {} is named twice, once as --contact, once as "
                            "--no-contact or with labels: one log is one of them",
                            logs[j].path.string())
              : fmt::format("fit: {} is named twice: it would count twice", logs[j].path.string()));
    }
  }
}

std::vector<experiments::FitLog> logs_of(const FitFlags& flags) {
  std::vector<experiments::FitLog> logs;
  for (const std::string& path : flags.logs) logs.push_back({path, {}});
  auto labels = logs::read_contact_intervals(flags.labels, logs.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    logs[i].labels = std::make_shared<const logs::ContactIntervals>(std::move(labels[i]));
  }
  for (const std::string& path : flags.contact) logs.push_back({path, true});
  for (const std::string& path : flags.no_contact) logs.push_back({path, false});
  if (logs.empty()) throw InputError("fit: a log is missing: touchdown fit LOG -o model.npz");
  return logs;
}

/// Applies the flags for densities to the estimator.
void shape_densities(experiments::EstimatorEntry& entry, const FitFlags& flags) {
  MeasurementFitConfig& fit = entry.fitting.torques->fit;
  if (!flags.grid.empty()) {
    fit.knee_count = flags.grid[0];
    fit.wheel_count = flags.grid[1];
  }
  if (!flags.bandwidth.empty()) fit.bandwidth = bandwidth_from(flags.bandwidth, "--bandwidth");
  if (!flags.bandwidth_floor.empty()) {
    fit.bandwidth_floor = bandwidth_from(flags.bandwidth_floor, "--bandwidth-floor");
  }
  if (!flags.knee_range.empty()) fit.knee_range = range_from(flags.knee_range, "--knee-range");
  if (!flags.wheel_range.empty()) fit.wheel_range = range_from(flags.wheel_range, "--wheel-range");
}

/// "robust, reference, … or measurement_only".
std::string fitted_estimators() {
  std::vector<std::string> names;
  for (const experiments::EstimatorEntry& entry : experiments::estimator_entries()) {
    if (entry.fitting.torques) names.push_back(entry.name);
  }
  const std::string last = names.back();
  names.pop_back();
  return fmt::format("{} or {}", fmt::join(names, ", "), last);
}

/// The flags must outlive the verb.
void add_fit_flags(Verb& verb, FitFlags& flags) {
  verb.option("log", &flags.logs, "Logs with ground truth: recordings of simulated runs")
      .value_name("LOG");
  verb.option("--contact", &flags.contact, "Logs in which both wheels are in contact all the time")
      .value_name("LOG");
  verb.option("--no-contact", &flags.no_contact, "Logs in which neither wheel is ever in contact")
      .value_name("LOG");
  verb.option("--labels", &flags.labels,
              "Contact intervals of each LOG, in the order of the logs: rows start,end,contact or "
              "start,end,left,right")
      .value_name("FILE.csv");
  verb.option("-o,--output", &flags.output, "Model to write").value_name("FILE.npz").required();
  verb.option("--estimator", &flags.estimator, "Estimator: " + fitted_estimators()).shows_default();
  verb.option("--set", &flags.hyperparameters,
              "Run and fit the estimator with another value of a hyperparameter, for example\n"
              "threshold=0.6")
      .value_name("NAME=NUMBER")
      .one_at_a_time();
  verb.flag("--no-accuracy", &flags.skips_accuracy,
            "Leave out the accuracy on left-out logs, which takes five more fits, and that of\n"
            "load_filter");
  verb.option(
          "--robot", &flags.robot,
          "Robot that recorded the logs, for the model's metadata (default: that of simulated\n"
          "logs). Its file gives the legs for the checks of labels (default: each simulated log's\n"
          "own, else Upkie's)")
      .value_name("NAME|FILE");
  verb.option("--skip", &flags.config.skip,
              "Time at the beginning of each log that is not used (s)")
      .between(0.0, 1e5)
      .shows_default();
  verb.option("--label-share", &flags.config.labels.share,
              "Ground truth: a wheel is in contact above this share of the robot's weight")
      .between(0.0, 1.0)
      .shows_default();
  verb.option("--label-window", &flags.config.labels.window,
              "Ground truth: the normal force is averaged over this time around each step (s)")
      .between(0.0, 1.0)
      .shows_default();
  verb.option("--grid", &flags.grid, "Grid points along knee and wheel torque (200 200)")
      .takes(2)
      .between(2, 5000);
  verb.option("--bandwidth", &flags.bandwidth,
              "Bandwidths of knee and wheel instead of Scott's rule (N·m)")
      .takes(2);
  verb.option("--bandwidth-floor", &flags.bandwidth_floor,
              "Lower limits of Scott's bandwidths of knee and wheel (N·m)")
      .takes(2);
  verb.option("--knee-range", &flags.knee_range, "Knee torques at the ends of the grid (N·m)")
      .takes(2);
  verb.option("--wheel-range", &flags.wheel_range, "Wheel torques at the ends of the grid (N·m)")
      .takes(2);
}

void show_samples(const experiments::LogFitReport& report) {
  for (const bool contact : {true, false}) {
    const std::size_t i = contact ? 1 : 0;
    print("{:<12} {} samples of both legs, bandwidth {:.4g} N·m (knee), {:.4g} N·m (wheel)\n",
          contact ? "contact" : "no contact", report.samples[i], report.bandwidth[i].knee,
          report.bandwidth[i].wheel);
  }
}

/// A model that agrees with wrong labels does so on its own logs, so that the accuracy there stands
/// beside that of models on steps that they were not fitted to.
void show_accuracy(const experiments::EstimatorEntry& entry,
                   const std::vector<experiments::FitLog>& logs,
                   const experiments::LogFitConfig& config, const Model& model) {
  const auto can_be_read_again = [](const experiments::FitLog& log) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(log.path, ignored);
  };
  if (!std::all_of(logs.begin(), logs.end(), can_be_read_again)) return;
  experiments::FitAccuracy accuracy;
  try {
    accuracy = experiments::accuracy_of_fit(entry, logs, config, model);
  } catch (const Stopped&) {
    throw Stopped("stopped; the model was written, and not judged");
  }
  print("{:<12} balanced accuracy {:.4f} on these logs, {}\n", "accuracy", accuracy.fitted,
        !accuracy.held_out ? "of which no part can be left out to judge the model by it"
        : accuracy.by_parts
            ? fmt::format("{:.4f} on every other {:g} s by a model of the rest", *accuracy.held_out,
                          experiments::part_length)
            : fmt::format("{:.4f} on each by a model of the others", *accuracy.held_out));
  print("{:<12} balanced accuracy {:.4f} of load_filter, without a fit, on these logs\n", "",
        accuracy.load_filter);
  print_warnings(accuracy.flights);
  const double own = accuracy.held_out.value_or(accuracy.fitted);
  if (own >= accuracy.load_filter) return;
  print_message(fmt::format(
      "touchdown: load_filter is better on these logs ({:.4f} against {:.4f}): use it\n",
      accuracy.load_filter, own));
}

void fit(const FitFlags& flags, const CliSession& session) {
  experiments::EstimatorEntry entry = experiments::estimator_entry(flags.estimator);
  const std::vector<experiments::FitLog> logs = logs_of(flags);
  if (!entry.fitting.torques) {  // an experiment may fit others
    throw InputError(fmt::format("--estimator: '{}' is not fitted{}{}: expected {}", entry.name,
                                 entry.fits() ? " to logs" : "",
                                 entry.fitting.trained_by.empty()
                                     ? ""
                                     : fmt::format(" ({} trains it)", entry.fitting.trained_by),
                                 fitted_estimators()));
  }
  shape_densities(entry, flags);
  experiments::LogFitConfig config = flags.config;
  config.stop = session.stop;
  config.shows_progress = true;
  config.hyperparameters = experiments::hyperparameters_of(flags.hyperparameters);
  config.robot = experiments::robot_called(flags.robot);
  std::vector<InputFile> inputs;
  for (const experiments::FitLog& log : logs) inputs.push_back({log.path, "log"});
  for (const std::string& labels : flags.labels) inputs.push_back({labels, "file of labels"});
  check_outputs(inputs, {flags.output});
  require_extension(flags.output, {".npz"}, "a model");
  require_different(logs);
  experiments::LogFitReport report;
  const Model model = experiments::fit_to_logs(entry, logs, config, report);
  logs::save_model(model, flags.output);
  print_warnings(report.warnings);
  if (report.unusable > 0) {
    print_message(fmt::format(
        "touchdown: {} samples of a leg are not finite, or beyond what a sensor measures, and were "
        "left out\n",
        report.unusable));
  }
  print("{}: {}, {:.3f} s of {}\n", flags.output, entry.title, report.fitted_to.seconds,
        experiments::plural(logs.size(), "log"));
  show_samples(report);
  if (!flags.skips_accuracy) show_accuracy(entry, logs, config, model);
  print("{:<12} touchdown estimate LOG --model {} --estimator {}\n", "next", flags.output,
        entry.name);
}

}  // namespace

void add_fit(CLI::App& program, const CliSession& session) {
  Verb verb(
      program, "fit",
      "touchdown fit stairs.mpack -o model.npz\n"
      "touchdown fit --contact rolling.mpack --no-contact hanging.mpack -o model.npz\n"
      "touchdown fit robot.mpack --labels robot.csv -o model.npz\n\n"
      "Fits an estimator's model to logs: simulated logs with ground truth, or a robot's logs. A\n"
      "robot's log is in contact all the time, never in contact, or labelled by hand.");
  const auto flags = std::make_shared<FitFlags>();
  add_fit_flags(verb, *flags);
  verb.action([flags, &session] { fit(*flags, session); });
}

}  // namespace touchdown::cli
