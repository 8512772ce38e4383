#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/cli/verb.hpp"
#include "core/program.hpp"
#include "experiments/logs/estimator.hpp"
#include "logs/log/reader.hpp"

namespace touchdown::cli {

/// How a log is read, and the estimator that runs on it.
struct LogOptions {
  std::string mapping = {};
  std::string model = {};
  std::string estimator = {};
  std::string robot = {};
  bool transfer = false;
  std::vector<std::string> hyperparameters = {};
};

/// The options must outlive the verb.
void add_log_options(Verb& verb, LogOptions& options);

/// Errors: those of `experiments::log_estimator`.
experiments::LogEstimator estimator_for(const LogOptions& options);

/// Adds all files of a log, so that no output replaces one of them.
void add_log(const std::string& log, const std::string& mapping, std::vector<InputFile>& inputs);

struct LogOpening {
  bool with_bytes = false;  ///< whether a mapped log's records are read as bytes, too
  std::function<void()> before_read = {};
};

/// "-" is standard input. Errors: those of the reader; `InputError` for a mapping of "-".
logs::LogReader open_log(const std::string& path, const LogOptions& options,
                         const CliSession& session, const LogOpening& opening = {});

/// Errors: `Error` with the number of findings.
void require_no_findings(std::size_t findings);

/// What looks wrong in a log, a line each.
void print_findings(const std::string& log, const std::vector<std::string>& findings);

}  // namespace touchdown::cli
