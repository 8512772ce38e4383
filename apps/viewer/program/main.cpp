#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/viewer/watch.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "core/resources.hpp"
#include "core/yaml.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/logs/log_steps.hpp"
#include "experiments/logs/robot.hpp"
#include "logs/log/recording_file.hpp"
#include "logs/mapping/conversion.hpp"
#include "render/report/filmed_run.hpp"
#include "render/report/subject.hpp"
#include "scenarios/generation/generate.hpp"
#include "scenarios/scenario_file.hpp"

namespace touchdown::viewer {

namespace {

enum class SubjectKind : int {
  scenario,  ///< a scenario file, or the name of a drawn scenario
  robot,     ///< a robot's MJCF, URDF or YAML file, on flat ground
  log,       ///< a recording or a robot's log
  run        ///< an experiment's run directory
};

namespace fs = std::filesystem;

struct WatchRequest {
  std::string subject;
  std::vector<std::string> estimators;  ///< NAME or NAME=MODEL; empty: the default ones
  std::string engine = "mujoco";
  std::uint64_t seed = 1;
  std::int64_t run = -1;
  std::vector<std::string> overrides;  ///< KEY=VALUE, of the scenario
  std::string robot;                   ///< of a log
  std::string mapping;                 ///< of a log in another layout
  std::string labels;                  ///< of a log
  fs::path record;
  fs::path film;
  double film_offset = 0.0;
  int width = 1280;
  int height = 720;
  bool statistics = false;
};

constexpr const char* flat_scenario = "scenarios/flat.yaml";

constexpr const char* usual_robot = "models/upkie.xml";

/// The estimators that are named NAME or NAME=MODEL. They may be used with any robot and rate.
std::vector<experiments::LogEstimator> estimators_of(const std::vector<std::string>& words,
                                                     const experiments::LogRobot& robot) {
  const std::vector<std::string> usual = {experiments::default_estimator, "upkie_observer"};
  std::vector<experiments::LogEstimator> estimators;
  for (const std::string& word : words.empty() ? usual : words) {
    const auto split = word.find('=');
    experiments::LogEstimatorRequest request{
        .name = word.substr(0, split), .robot = robot, .transfer = true};
    if (split != std::string::npos) {
      request.model = word.substr(split + 1);
    } else if (experiments::estimator_entry(word).fits()) {
      throw InputError(
          fmt::format("--estimator {0}: has to be fitted: expected {0}=MODEL.npz", word));
    }
    experiments::LogEstimator estimator = experiments::log_estimator(std::move(request));
    // The title of a model ends with its file, for which there is no room.
    estimator.entry.title.resize(
        std::min(estimator.entry.title.size(), estimator.entry.title.find(" (")));
    estimators.push_back(std::move(estimator));
  }
  return estimators;
}

std::vector<std::pair<std::string, noise::SensorProfile>> known_sensors() {
  std::vector<std::pair<std::string, noise::SensorProfile>> sensors = {{"ideal", {}}};
  for (const fs::path& file : resources_in("noise/profiles", ".yaml")) {
    if (file.stem() == "ideal") continue;
    sensors.emplace_back(file.stem().string(), noise::find_sensor_profile(file));
  }
  return sensors;
}

scenarios::Scenario scenario_of(const WatchRequest& request, SubjectKind kind) {
  const bool is_robot = kind == SubjectKind::robot;
  YamlDocument document = scenarios::scenario_document(is_robot ? flat_scenario : request.subject);
  if (is_robot) document.override_value("robot=" + request.subject);
  for (const std::string& assignment : request.overrides) document.override_value(assignment);
  experiments::require_yaml_kind(document, experiments::YamlKind::scenario);
  return scenarios::complete_scenario(document);
}

/// The robot that a log's recording contains, else the named one on flat ground.
models::RobotModel robot_of(const logs::Recording& recording, const std::string& named) {
  if (recording.info.scenario_yaml.empty() || !named.empty()) {
    return models::compile_robot_model(
        named.empty() ? find_program_file(usual_robot) : find_resource(named), {});
  }
  return render::recorded_robot(recording);
}

/// Runs all estimators over the log. True contact is that of the labels, or the log's own.
void evaluate(const WatchRequest& request, const logs::ContactIntervals* labels, LoggedRun& run) {
  experiments::LogRobot robot;
  if (!request.robot.empty()) robot = experiments::robot_called(request.robot);
  const std::vector<experiments::LogEstimator> requested = estimators_of(request.estimators, robot);
  logs::LogReader reader = logs::open_log(request.subject, request.mapping, nullptr);
  const bool has_labels = labels != nullptr && !labels->intervals.empty();
  experiments::LogSteps log(reader, has_labels ? labels : nullptr, robot);
  std::vector<std::unique_ptr<ContactEstimator>> estimators;
  for (std::size_t i = 0; i < requested.size(); ++i) {
    estimators.push_back(requested[i].make(log.sample_rate(), log.info()));
    render::BeliefTrack& track = run.beliefs.emplace_back();
    track.name = requested[i].entry.title;
    track.colour = estimator_colour(i);
  }
  while (const experiments::LogStep* step = log.next()) {
    for (std::size_t i = 0; i < estimators.size(); ++i) {
      render::add_belief(run.beliefs[i], estimators[i].get(), estimators[i]->update(step->signals));
    }
  }
  log.require_labels_within();
  if (labels != nullptr) {
    run.contact = labelled_contact(run.recording, *labels);
  } else if (!run.recording.truth.empty()) {
    run.contact = true_contact(run.recording, {});
  }
  print_warnings(log.findings());
}

/// Errors: `InputError` for a file of another kind.
SubjectKind kind_of(const std::string& subject) {
  if (scenarios::is_drawn(subject)) return SubjectKind::scenario;
  if (is_folder(subject)) return SubjectKind::run;
  const std::string extension = fs::path(subject).extension().string();
  if (extension == ".mpack") return SubjectKind::log;
  if (extension == ".xml" || extension == ".urdf") return SubjectKind::robot;
  if (extension == ".yaml" || extension == ".yml") {
    const YamlDocument document = YamlDocument::load(find_resource(subject));
    const bool is_robot = document.root().IsMap() && document.root()["mjcf"].IsDefined();
    return is_robot ? SubjectKind::robot : SubjectKind::scenario;
  }
  throw InputError(fmt::format(
      "watch: '{}': expected a scenario (.yaml), a robot (.xml, .urdf, .yaml), a log (.mpack, or "
      "another one with --mapping) or a run directory",
      subject));
}

/// Errors: `InputError` for a scenario, a robot or an estimator that cannot be used.
LiveRequest live_request(const WatchRequest& request, SubjectKind kind) {
  LiveRequest live;
  live.scene = {scenario_of(request, kind), request.engine, request.seed, request.run};
  live.estimators = estimators_of(request.estimators,
                                  experiments::robot_called(live.scene.scenario.robot.string()));
  live.sensors = known_sensors();
  live.record = request.record;
  live.width = request.width;
  live.height = request.height;
  live.measures = request.statistics;
  return live;
}

LoggedRun logged_run(const WatchRequest& request, const logs::ContactIntervals* labels,
                     SubjectKind kind) {
  if (kind == SubjectKind::run) {
    std::vector<render::FilmedRun> filmed =
        render::filmed_runs(render::read_subject(request.subject));
    if (filmed.empty()) {
      throw InputError(
          fmt::format("{}: has no recording of the run that it films", request.subject));
    }
    render::FilmedRun& first = filmed.front();
    const auto contact = true_contact(first.recording, first.labels);
    return {.name = first.recording.info.scenario,
            .robot = std::move(first.robot),
            .recording = std::move(first.recording),
            .beliefs = std::move(first.beliefs),
            .contact = contact};
  }
  std::vector<std::string> warnings;
  logs::LogReader reader = logs::open_log(request.subject, request.mapping, nullptr);
  logs::Recording recording = logs::read_recording(reader, &warnings);
  print_warnings(warnings);
  models::RobotModel robot = robot_of(recording, request.robot);
  LoggedRun run{.name = fs::path(request.subject).filename().string(),
                .robot = std::move(robot),
                .recording = std::move(recording),
                .beliefs = {},
                .contact = {}};
  evaluate(request, labels, run);
  return run;
}

void print_statistics(const LiveSession& session) {
  print("{} pictures in {:.1f} s: {:.1f} a second\n", session.frames, session.seconds,
        session.frames / std::max(1e-3, session.seconds));
  if (!session.times || session.frames == 0) return;
  const double each = 1e3 / session.frames;
  print("a picture: scene {:.1f} ms; labels, panel and plots {:.1f} ms; display {:.1f} ms\n",
        each * session.times->scene, each * session.times->overlay, each * session.times->display);
}

int play(const WatchRequest& request, SubjectKind kind, const std::atomic<bool>& stop) {
  LogSession session{.film = request.film,
                     .film_offset = request.film_offset,
                     .width = request.width,
                     .height = request.height};
  if (!request.labels.empty()) session.labels = logs::read_begun_intervals(request.labels);
  const logs::ContactIntervals* const shown = session.labels ? &*session.labels : nullptr;
  print("{}", watch_log(logged_run(request, shown, kind), session, stop));
  return good;
}

int watch(const WatchRequest& request, const std::atomic<bool>& stop) {
  if (!request.record.empty()) {
    require_extension(request.record, {".mpack"}, "a recording");
    check_outputs({{request.subject, "subject"}}, {request.record});
  }
  const SubjectKind kind = request.mapping.empty() ? kind_of(request.subject) : SubjectKind::log;
  if (!request.labels.empty()) {
    require_extension(request.labels, {".csv"}, "a file of labels");
    if (kind != SubjectKind::log) throw InputError("--labels: expected a log to label");
  }
  if (kind == SubjectKind::log || kind == SubjectKind::run) {
    if (!request.record.empty()) {
      throw InputError("--record: a log cannot be driven: name a scenario or a robot");
    }
    return play(request, kind, stop);
  }
  if (!request.film.empty()) throw InputError("--film: expected a log or a run directory to play");
  const LiveSession session = watch_live(live_request(request, kind), stop);
  for (const std::string& line : session.recorded) print("{}\n", line);
  print_statistics(session);
  return good;
}

int run_program(int argc, char** argv) {
  CLI::App program(
      "touchdown watch scenarios/stairs.yaml\n"
      "touchdown watch my_robot.xml --estimator load_filter --estimator robust=mine.npz\n"
      "touchdown watch run.mpack\n"
      "touchdown watch robot.mpack --labels labels.csv --film robot.mp4 --film-offset 2.5\n\n"
      "Shows a robot in a window while estimators run on it. A scenario or a robot is simulated "
      "in\n"
      "real time and can be driven; a log, or an experiment's run directory, is played. `h` lists\n"
      "all keys.",
      "touchdown watch");
  WatchRequest request;
  program
      .add_option("subject", request.subject,
                  "Scenario file or drawn scenario, robot's file, recording or log, or run "
                  "directory")
      ->required();
  program
      .add_option("--estimator", request.estimators,
                  "Estimator to show, or NAME=MODEL; several are possible (default: the filter "
                  "of loads and Upkie's observer)")
      ->type_name("NAME[=MODEL]")
      ->allow_extra_args(false);
  program.add_option("--simulator", request.engine, "Physics engine (default: mujoco)")
      ->check([](const std::string& name) {
        return not_one_of(name, {"mujoco", "bullet"});
      });
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
  program
      .add_option("--mapping", request.mapping,
                  "Maps the columns or topics of a log to signals, as for `touchdown convert`")
      ->type_name("FILE.yaml");
  program
      .add_option(
          "--labels", request.labels,
          "Contact labels of a log, to be edited; begun if the file is not there. Each edit "
          "is saved")
      ->type_name("FILE.csv");
  program.add_option("--film", request.film, "Film of a log, shown beside the robot")
      ->type_name("FILE.mp4");
  program
      .add_option("--film-offset", request.film_offset,
                  "Time of the film when that of the log is 0 (s; default: 0)")
      ->check(CLI::Range(-1e6, 1e6));
  program.add_option("--record", request.record, "Recording to write of what was driven")
      ->type_name("FILE.mpack");
  program.add_flag("--statistics", request.statistics,
                   "Print how long the parts of a picture took, at the end of a live run");
  constexpr int least = 600;
  constexpr int most = 8000;
  program.add_option("--width", request.width, "Width of the window (pixels)")
      ->check(CLI::Range(least, most));
  program.add_option("--height", request.height, "Height of the window (pixels)")
      ->check(CLI::Range(least, most));
  return run_command(program, argc, argv, [&] { return watch(request, stop_on_interrupt()); });
}

}  // namespace

}  // namespace touchdown::viewer

int main(int argc, char** argv) {
  touchdown::stop_on_interrupt();
  touchdown::open_standard_streams();
  return touchdown::finished([&] { return touchdown::viewer::run_program(argc, argv); });
}
