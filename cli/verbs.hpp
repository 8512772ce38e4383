#pragma once

#include <atomic>
#include <string>

#include "cli/verb.hpp"

namespace touchdown::cli {

/// The state that all verbs share.
struct CliSession {
  std::string command;                      ///< the command line
  std::string program;                      ///< the first word of the command line
  const std::atomic<bool>* stop = nullptr;  ///< becomes true on Ctrl-C
};

/// Each function adds one verb and its flags to the program. The verb runs at the end of parsing.
void add_run(CLI::App& program, const CliSession& session);
void add_merge(CLI::App& program, const CliSession& session);
void add_generate(CLI::App& program, const CliSession& session);
void add_simulate(CLI::App& program, const CliSession& session);
void add_render(CLI::App& program, const CliSession& session);
void add_report(CLI::App& program, const CliSession& session);
void add_train(CLI::App& program, const CliSession& session);
void add_watch(CLI::App& program, const CliSession& session);
void add_fit(CLI::App& program, const CliSession& session);
void add_estimate(CLI::App& program, const CliSession& session);
void add_check(CLI::App& program, const CliSession& session);
void add_export(CLI::App& program, const CliSession& session);
void add_score(CLI::App& program, const CliSession& session);
void add_clean(CLI::App& program, const CliSession& session);
void add_list(CLI::App& program, const CliSession& session);
void add_keys(CLI::App& program, const CliSession& session);
void add_manual(CLI::App& program, const CliSession& session);

}  // namespace touchdown::cli
