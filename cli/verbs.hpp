#pragma once

#include <atomic>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace touchdown::cli {

/// What all verbs share.
struct CliSession {
  std::string command;                      ///< what was typed
  const std::atomic<bool>* stop = nullptr;  ///< becomes true on Ctrl-C
  std::function<void()> action;             ///< set by the verb that was asked for
};

/// Each adds its verb and flags to the program; the verb's callback sets `session.action`.
void add_run(CLI::App& program, CliSession& session);
void add_merge(CLI::App& program, CliSession& session);
void add_simulate(CLI::App& program, CliSession& session);
void add_render(CLI::App& program, CliSession& session);
void add_report(CLI::App& program, CliSession& session);
void add_train(CLI::App& program, CliSession& session);
void add_fit(CLI::App& program, CliSession& session);
void add_estimate(CLI::App& program, CliSession& session);
void add_list(CLI::App& program, CliSession& session);

}  // namespace touchdown::cli
