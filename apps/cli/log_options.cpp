#include "apps/cli/log_options.hpp"

#include <span>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "experiments/results/captions.hpp"
#include "logs/log/byte_source.hpp"
#include "logs/mapping/conversion.hpp"

namespace touchdown::cli {

void add_log_options(Verb& verb, LogOptions& options) {
  verb.option("--mapping", &options.mapping,
              "Maps the columns or topics of the logs to signals, as for `touchdown convert`")
      .value_name("FILE.yaml");
  verb.option("--model", &options.model,
              "Model that `touchdown fit` wrote, or load_filter's that `touchdown convert` wrote")
      .value_name("FILE.npz");
  verb.option("--estimator", &options.estimator,
              "Estimator from `touchdown list` (default: the one that the model was fitted for; "
              "without\na model load_filter, which needs the robot alone)");
  verb.option(
          "--robot", &options.robot,
          "Robot that recorded the logs (default: that of a simulated log); it must be the\n"
          "model's. Its file gives the legs to load_filter (default: the model's, else those of\n"
          "a simulated log's robot, else Upkie's)")
      .value_name("NAME|FILE");
  verb.option(
          "--set", &options.hyperparameters,
          "Run the estimator with another value of a hyperparameter than its model's, for example\n"
          "leave_below=0.05")
      .value_name("NAME=NUMBER")
      .one_at_a_time();
  verb.flag("--transfer", &options.transfer, "Use a model on another robot than it was fitted for");
}

experiments::LogEstimator estimator_for(const LogOptions& options) {
  return experiments::log_estimator({options.estimator, options.model,
                                     experiments::robot_called(options.robot), options.transfer,
                                     experiments::hyperparameters_of(options.hyperparameters)});
}

void add_log(const std::string& log, const std::string& mapping, std::vector<InputFile>& inputs) {
  for (const std::filesystem::path& file : logs::files_of_log(log, mapping)) {
    inputs.push_back({file, file == mapping ? "mapping" : "log"});
  }
}

logs::LogReader open_log(const std::string& path, const LogOptions& options,
                         const CliSession& session, const LogOpening& opening) {
  const bool is_live = path == "-";
  if (!options.mapping.empty()) {
    if (is_live) throw InputError("--mapping: expected a file or a bag, found standard input");
    return {logs::mapped_records(path, options.mapping,
                                 {.stop = session.stop, .with_bytes = opening.with_bytes}),
            path};
  }
  return {[before_read = opening.before_read,
           bytes = logs::file_source(path, session.stop)](std::span<char> buffer) {
            if (before_read) before_read();
            return bytes(buffer);
          },
          is_live ? "standard input" : path};
}

void require_no_findings(std::size_t findings) {
  if (findings == 0) return;
  throw Error(
      fmt::format("--strict: {} about the signals", experiments::plural(findings, "finding")));
}

void print_findings(const std::string& log, const std::vector<std::string>& findings) {
  for (const std::string& finding : findings) {
    print_message(fmt::format("touchdown: {}: {}\n", log, finding));
  }
}

}  // namespace touchdown::cli
