#pragma once

namespace touchdown::cli {

/// The whole program `touchdown`: installs its handlers of signals, runs the command, reports
/// errors. Returns the exit code. It changes the process, so that a process runs it once.
int run_program(int argc, char** argv);

}  // namespace touchdown::cli
