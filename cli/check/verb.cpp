#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "cli/check/log.hpp"
#include "cli/check/robot.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "experiments/logs/robot.hpp"

namespace touchdown::cli {

namespace {

struct CheckFlags {
  std::vector<std::string> files;
  std::string mapping;
  std::string robot;
  bool strict = false;
  bool json = false;
};

/// What the checks found: complaints about robots always count, findings about logs if --strict.
struct Found {
  std::size_t complaints = 0;
  std::size_t findings = 0;
};

/// The type of a file follows from its extension; with a mapping all files are logs.
void check_file(const std::string& file, const CheckFlags& flags, const CliSession& session,
                Found& found) {
  if (flags.mapping.empty() && is_robot_file(file)) {
    found.complaints += check_robot(file, flags.json, session);
    return;
  }
  if (flags.json) throw InputError(fmt::format("{}: --json is for robots", file));
  found.findings +=
      check_log(file, flags.mapping, experiments::robot_of_file(flags.robot), session);
}

void check(const CheckFlags& flags, const CliSession& session) {
  const bool is_live = std::find(flags.files.begin(), flags.files.end(), "-") != flags.files.end();
  if (is_live && !flags.mapping.empty()) {
    throw InputError("--mapping: expected a file or a bag, found standard input");
  }
  Found found;
  for (const std::string& file : flags.files) check_file(file, flags, session, found);
  const std::size_t all = found.complaints + (flags.strict ? found.findings : 0);
  if (all > 0) throw Error(fmt::format("check: {} finding{}", all, all == 1 ? "" : "s"));
}

}  // namespace

void add_check(CLI::App& program, const CliSession& session) {
  Verb verb(program, "check",
            "touchdown check models/upkie.xml\n"
            "touchdown check robot.mpack --robot my_robot.xml --strict\n"
            "touchdown check rosbag2_2026_03_01/ --mapping robot.yaml\n\n"
            "Checks robots and logs. Of a robot it prints what was read from its file, what is\n"
            "ignored, where the engines differ, and how it stands for two seconds in each. The\n"
            "exit code is 1 if it cannot be simulated. Of a log it checks whether the signals can\n"
            "be those of a wheeled biped: clock, units, signs, axes, gravity, loads, dead\n"
            "channels. It prints one line per finding, with its likely cause. With --mapping it\n"
            "reads another robot's logs: ROS 2 bags, CSV or NumPy arrays.");
  const auto flags = std::make_shared<CheckFlags>();
  verb.option("file", &flags->files,
              "Robots: MJCF files, or YAML files about an MJCF or URDF. Logs in Upkie's layout, "
              "or in another one with --mapping; - is standard input")
      .value_name("FILE")
      .required();
  verb.option("--mapping", &flags->mapping,
              "Maps the columns or topics of the logs to signals, as for `touchdown export`")
      .value_name("FILE.yaml");
  verb.option("--robot", &flags->robot,
              "File of the robot that recorded the logs: gives weight, legs and ranges of joints\n"
              "(default: that of a simulated log, else Upkie's)")
      .value_name("FILE");
  verb.flag("--strict", &flags->strict, "Exit with code 1 if there is a finding about a log");
  verb.flag("--json", &flags->json, "Print JSON about robots");
  verb.action([flags, &session] { check(*flags, session); });
}

}  // namespace touchdown::cli
