#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/check/log.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"

namespace touchdown::cli {

namespace {

struct CheckFlags {
  std::vector<std::string> files;
  std::string robot;
  bool strict = false;
};

/// Returns the number of findings. The type of a file follows from its extension.
std::size_t check_file(const std::string& file, const CheckFlags& flags,
                       const CliSession& session) {
  return check_log(file, experiments::robot_called(flags.robot), session);
}

void check(const CheckFlags& flags, const CliSession& session) {
  std::size_t findings = 0;
  for (const std::string& file : flags.files) findings += check_file(file, flags, session);
  if (flags.strict && findings > 0) {
    throw Error(fmt::format("check: {} finding{}", findings, findings == 1 ? "" : "s"));
  }
}

}  // namespace

void add_check(CLI::App& program, const CliSession& session) {
  Verb verb(program, "check",
            "touchdown check robot.mpack\n"
            "touchdown check robot.mpack --robot my_robot.xml --strict\n\n"
            "Checks whether a log's signals can be those of a wheeled biped: clock, units, signs,\n"
            "axes, gravity, loads, dead channels. Prints one line per finding, with its likely\n"
            "cause.");
  const auto flags = std::make_shared<CheckFlags>();
  verb.option("file", &flags->files, "Logs in Upkie's layout; - is standard input")
      .value_name("FILE")
      .required();
  verb.option("--robot", &flags->robot,
              "Robot that recorded the logs: its file gives weight, legs and ranges of joints\n"
              "(default: that of a simulated log, else Upkie's)")
      .value_name("NAME|FILE");
  verb.flag("--strict", &flags->strict, "Exit with code 1 if there is a finding");
  verb.action([flags, &session] { check(*flags, session); });
}

}  // namespace touchdown::cli
