#include <memory>

#include <fmt/format.h>

#include "cli/fit/flags.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/logs/fit.hpp"

namespace touchdown::cli {

namespace {

void show_samples(const experiments::LogFitReport& report, bool with_bandwidth) {
  for (const bool contact : {true, false}) {
    const std::size_t i = contact ? 1 : 0;
    fmt::print("{:<12} {} samples of both legs", contact ? "contact" : "no contact",
               report.samples[i]);
    if (with_bandwidth) {
      fmt::print(", bandwidth {:.4g} N·m (knee), {:.4g} N·m (wheel)", report.bandwidth[i].knee,
                 report.bandwidth[i].wheel);
    }
    fmt::print("\n");
  }
}

void fit(const FitFlags& flags, const CliSession& session) {
  experiments::EstimatorEntry entry = experiments::estimator_entry(flags.estimator);
  const std::vector<experiments::FitLog> logs = logs_of(flags);
  if (!entry.fits()) {
    throw InputError(fmt::format(
        "--estimator: '{}' is not fitted{}: expected {}", entry.name,
        entry.trained_by.empty() ? "" : fmt::format(" ({} trains it)", entry.trained_by),
        fitted_estimators()));
  }
  shape_densities(entry, flags);
  experiments::LogFitConfig config = flags.config;
  config.stop = session.stop;
  experiments::LogFitReport report;
  experiments::write_fitted_model(experiments::fit_to_logs(entry, logs, config, report),
                                  flags.output);
  for (const std::string& warning : report.warnings) fmt::print(stderr, "touchdown: {}\n", warning);
  if (report.unusable > 0) {
    fmt::print(stderr, "touchdown: {} samples of a leg are not finite and were left out\n",
               report.unusable);
  }
  fmt::print("{}: {}, {:.3f} s of {} {}\n", flags.output, entry.title, report.seconds, logs.size(),
             logs.size() == 1 ? "log" : "logs");
  show_samples(report, entry.config.has_value());
  fmt::print("{:<12} touchdown estimate LOG --model {} --estimator {}\n", "next", flags.output,
             entry.name);
}

}  // namespace

void add_fit(CLI::App& program, CliSession& session) {
  CLI::App* verb = program.add_subcommand(
      "fit",
      "touchdown fit stairs.mpack -o model.npz\n"
      "touchdown fit --contact rolling.mpack --no-contact hanging.mpack -o model.npz\n\n"
      "Fits an estimator's model to logs: to simulated ones with their ground truth, or to a\n"
      "robot's, each of which is contact or no contact all along.");
  const auto flags = std::make_shared<FitFlags>();
  add_fit_flags(*verb, *flags);
  verb->callback(
      [flags, &session] { session.action = [flags, &session] { fit(*flags, session); }; });
}

}  // namespace touchdown::cli
