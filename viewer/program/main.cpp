#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/error.hpp"
#include "core/program.hpp"
#include "viewer/subject.hpp"
#include "viewer/watch_live.hpp"
#include "viewer/watch_log.hpp"

namespace touchdown::viewer {

namespace {

struct Flags {
  WatchRequest request;
  std::filesystem::path record;
  int width = 1280;
  int height = 720;
  bool statistics = false;
};

void print_statistics(const LiveSession& session) {
  print("{} pictures in {:.1f} s: {:.1f} a second\n", session.frames, session.seconds,
        session.frames / std::max(1e-3, session.seconds));
  if (!session.times || session.frames == 0) return;
  const double each = 1e3 / session.frames;
  print("a picture: scene {:.1f} ms; labels, panel and plots {:.1f} ms; display {:.1f} ms\n",
        each * session.times->scene, each * session.times->overlay, each * session.times->display);
}

int watch(Flags& flags, const std::atomic<bool>& stop) {
  if (!flags.record.empty()) {
    require_extension(flags.record, {".mpack"}, "a recording");
    check_outputs({{flags.request.subject, "subject"}}, {flags.record});
  }
  const SubjectKind kind = kind_of(flags.request.subject);
  if (kind == SubjectKind::log || kind == SubjectKind::run) {
    if (!flags.record.empty()) {
      throw InputError("--record: a log cannot be driven: name a scenario or a robot");
    }
    watch_log(logged_run(flags.request, kind), flags.width, flags.height, stop);
    return good;
  }
  LiveRequest request = live_request(flags.request, kind);
  request.record = flags.record;
  request.width = flags.width;
  request.height = flags.height;
  request.measures = flags.statistics;
  const LiveSession session = watch_live(std::move(request), stop);
  for (const std::string& line : session.recorded) print("{}\n", line);
  print_statistics(session);
  return good;
}

int run_program(int argc, char** argv) {
  CLI::App program(
      "touchdown watch scenarios/stairs.yaml\n"
      "touchdown watch my_robot.xml --estimator shipped --estimator support_force\n"
      "touchdown watch run.mpack\n\n"
      "Shows a robot in a window while estimators run on it. A scenario or a robot is simulated "
      "in\n"
      "real time and can be driven; a log, or an experiment's run directory, is played. `h` lists\n"
      "all keys.",
      "touchdown watch");
  Flags flags;
  WatchRequest& request = flags.request;
  program
      .add_option("subject", request.subject,
                  "Scenario file or drawn scenario, robot's file, recording or log, or run "
                  "directory")
      ->required();
  program
      .add_option("--estimator", request.estimators,
                  "Estimator to show, or NAME=MODEL; several are possible (default: the shipped "
                  "model and Upkie's observer)")
      ->type_name("NAME[=MODEL]")
      ->allow_extra_args(false);
  program.add_option("--simulator", request.engine, "Physics engine (default: mujoco)")
      ->check(CLI::IsMember({"mujoco", "bullet"}));
  program.add_option("--run", request.run, "Index of the first random draw (default: none)")
      ->check(CLI::NonNegativeNumber);
  program.add_option("--seed", request.seed, "Random seed (default: 1)");
  program
      .add_option("--set", request.overrides,
                  "Change a value of the scenario, for example end.duration=5")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  program.add_option("--robot", request.robot,
                     "Robot of a log that does not contain it (default: models/upkie.xml)");
  program.add_option("--labels", request.labels, "Labels of contact of a log")
      ->type_name("FILE.csv");
  program.add_option("--record", flags.record, "Recording to write of what was driven")
      ->type_name("FILE.mpack");
  program.add_flag("--statistics", flags.statistics,
                   "Print how long the parts of a picture took, at the end of a live run");
  constexpr int least = 600;
  constexpr int most = 8000;
  program.add_option("--width", flags.width, "Width of the window (pixels)")
      ->check(CLI::Range(least, most));
  program.add_option("--height", flags.height, "Height of the window (pixels)")
      ->check(CLI::Range(least, most));
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help
    return program.exit(success);
  } catch (const CLI::ParseError& error) {
    return complain(fmt::format("watch: {}", refused_words(program, error.what())), wrong_request);
  }
  try {
    return watch(flags, stop_on_interrupt());
  } catch (const InputError& error) {
    return complain(error.what(), wrong_request);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return complain(error.what(), failed);
  }
}

}  // namespace

}  // namespace touchdown::viewer

int main(int argc, char** argv) {
  touchdown::stop_on_interrupt();
  touchdown::open_standard_streams();
  return touchdown::finished([&] { return touchdown::viewer::run_program(argc, argv); });
}
