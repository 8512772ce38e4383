#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "apps/cli/verb.hpp"
#include "core/error.hpp"
#include "core/fields.hpp"
#include "core/program.hpp"
#include "core/progress.hpp"
#include "core/resources.hpp"
#include "core/stop.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/logs/robot.hpp"
#include "experiments/results/captions.hpp"
#include "logs/log/reader.hpp"
#include "logs/log/recording_file.hpp"
#include "noise/reported_signals.hpp"
#include "noise/sensor_profile.hpp"
#include "render/film/request.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/generation/generate.hpp"
#include "scenarios/robot_check.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scenario_file.hpp"

namespace touchdown::cli {

namespace {

struct SimulateFlags {
  std::string scenario;
  std::string simulator;  ///< empty: MuJoCo, or the one of the recording
  std::string output;
  std::string sensors;  ///< empty: ideal
  std::vector<std::string> overrides;
  std::uint64_t seed = 1;
  std::int64_t run = -1;
  std::int64_t recorded_run = 0;  ///< only stored in the recording
};

/// The scenario of a recorded run, to simulate it again: its draws are done. The flags get the
/// engine, the seed and the run of the recording.
YamlDocument recorded_scenario(SimulateFlags& flags) {
  logs::LogReader log(find_resource(flags.scenario));
  const logs::RecordingInfo info = log.info();
  if (info.scenario_yaml.empty()) {
    throw InputError(
        fmt::format("{}: contains no scenario: it is not a recording of `touchdown "
                    "simulate`",
                    flags.scenario));
  }
  const bool names_robot = std::ranges::any_of(
      flags.overrides, [](const std::string& one) { return one.starts_with("robot="); });
  if (!names_robot) experiments::require_recorded_robot(info, flags.scenario);
  if (flags.simulator.empty()) flags.simulator = info.simulator;
  flags.seed = info.seed;
  flags.recorded_run = info.run;
  return YamlDocument::parse(info.scenario_yaml, flags.scenario);
}

/// Replaces the ideal signals by those that the sensors report, with draws of the run's seed. Steps
/// without a record are removed.
void report_through(const noise::SensorProfile& sensors, logs::Recording& recording) {
  const noise::NoiseKey key{recording.info.seed, static_cast<std::uint64_t>(std::max<std::int64_t>(
                                                     0, recording.info.run))};
  noise::report_through(sensors, key, recording.period(), recording.observation);
  noise::report_targets(sensors, key, recording.action);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    if (std::isnan(recording.observation[k].time)) continue;
    recording.observation[kept] = recording.observation[k];
    recording.action[kept] = recording.action[k];
    recording.truth[kept] = recording.truth[k];
    ++kept;
  }
  recording.observation.resize(kept);
  recording.action.resize(kept);
  recording.truth.resize(kept);
}

void simulate(SimulateFlags flags, const CliSession& session) {
  const bool is_recording = std::filesystem::path(flags.scenario).extension() == ".mpack";
  YamlDocument document =
      is_recording ? recorded_scenario(flags) : scenarios::scenario_document(flags.scenario);
  if (flags.simulator.empty()) flags.simulator = "mujoco";
  for (const std::string& assignment : flags.overrides) document.override_value(assignment);
  experiments::require_yaml_kind(document, experiments::YamlKind::scenario);
  scenarios::Scenario scenario = scenarios::complete_scenario(document);
  check_outputs({{document.name(), "scenario"}, {scenario.robot, "robot"}}, {flags.output});
  require_extension(flags.output, {".mpack"}, "a recording");
  std::optional<noise::SensorProfile> sensors;
  if (!flags.sensors.empty()) {
    sensors = from_yaml<noise::SensorProfile>(YamlDocument::load(find_resource(flags.sensors)));
  }
  if (flags.run >= 0) scenario = scenarios::perturbed(scenario, flags.seed, flags.run);

  const auto scene = scenarios::compile_scene(scenario);
  logs::Recording recording;
  {
    constexpr double ticks_per_second = 1000.0;
    Progress progress("simulating", "ms",
                      static_cast<std::int64_t>(ticks_per_second * scenario.end.duration));
    std::int64_t shown = 0;
    recording =
        scenarios::play(scenario, *scenarios::make_simulator(scenario, flags.simulator, scene),
                        flags.seed, std::max(flags.run, flags.recorded_run), [&](double time) {
                          const auto ticks = static_cast<std::int64_t>(ticks_per_second * time);
                          progress.advance(ticks - shown);
                          shown = ticks;
                          return !*session.stop;
                        });
  }
  end_if(session.stop);
  if (sensors) report_through(*sensors, recording);
  logs::write_recording(recording, flags.output);
  print("{}: {} {}, {} of a wheel\n", flags.output, recording.info.scenario,
        scenarios::ending_text(recording, scenario.end) +
            scenarios::part_on_terrain(*scene, recording),
        experiments::plural(render::wheel_flights(recording, {}).size(), "flight"));
}

}  // namespace

void add_simulate(CLI::App& program, const CliSession& session) {
  Verb verb(program, "simulate",
            "touchdown simulate scenarios/stairs.yaml --simulator bullet -o stairs.mpack\n\n"
            "Simulates one run of a scenario and records it as an Upkie log.");
  const auto flags = std::make_shared<SimulateFlags>();
  verb.option("scenario", &flags->scenario,
              "Scenario file, a drawn scenario such as drawn:kerbs_7_000, or a recording: its run "
              "is simulated again")
      .required();
  verb.option("--simulator", &flags->simulator,
              "Physics engine (default: mujoco, or the one of the recording)");
  verb.option("-o,--output", &flags->output, "Recording to write")
      .value_name("FILE.mpack")
      .required();
  verb.option("--sensors", &flags->sensors,
              "Sensors that report the signals, such as noise/profiles/upkie.yaml (default: ideal "
              "ones)")
      .value_name("FILE");
  verb.option("--run", &flags->run,
              "Index of the run: draws its perturbations from the seed (default: no perturbations)")
      .between(0.0, std::numeric_limits<int>::max());
  verb.option("--seed", &flags->seed, "Random seed").shows_default();
  verb.option("--set", &flags->overrides,
              "Override a value of the scenario, for example end.duration=5")
      .value_name("KEY=VALUE")
      .one_at_a_time();
  verb.action([flags, &session] { simulate(*flags, session); });
}

}  // namespace touchdown::cli
