#pragma once

#include <string>

#include "cli/verbs.hpp"
#include "experiments/logs/robot.hpp"

namespace touchdown::cli {

/// Checks one log and prints its rate, its length and what is implausible about it, one line each.
/// `mapping` is the mapping file of another robot's log or bag; empty for a log in Upkie's layout.
/// Returns the number of findings. Errors: `InputError` for a log that cannot be read.
std::size_t check_log(const std::string& path, const std::string& mapping,
                      const experiments::LogRobot& robot, const CliSession& session);

}  // namespace touchdown::cli
