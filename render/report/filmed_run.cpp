#include "render/report/filmed_run.hpp"

#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/progress.hpp"
#include "core/resources.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/evaluation/tuning_table.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/logs/robot.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/plan/request.hpp"
#include "experiments/plan/rollouts.hpp"
#include "logs/log/recording_file.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/palette.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::render {

namespace {

namespace fs = std::filesystem;

scenarios::Scenario recorded_scenario(const logs::Recording& recording) {
  const logs::RecordingInfo& info = recording.info;
  if (info.scenario_yaml.empty()) {
    throw InputError(
        "the recording does not contain its terrain: a robot's own log cannot be drawn");
  }
  experiments::require_recorded_robot(info, fmt::format("{} in {}", info.scenario, info.simulator));
  scenarios::Scenario scenario = scenarios::scenario_from_yaml(
      YamlDocument::parse(info.scenario_yaml, info.scenario + " (in the log)"));
  scenario.robot = find_resource(scenario.robot);
  return scenario;
}

/// An estimator's beliefs along a noisy recording. `noise` was drawn for the run.
BeliefTrack beliefs_of(const experiments::Experiment& experiment,
                       const experiments::Condition& condition,
                       const experiments::FittedModels& models, const experiments::RunSignals& run,
                       const experiments::NoiseRun& noise, const noise::SensorNoise& levels) {
  const experiments::EstimatorEntry entry = experiments::entry_of(experiment, condition, models);
  const experiments::EstimatorSetup setup =
      experiments::setup_of(experiment, condition, models, run);
  const auto by_step = entry.making.whole_run ? nullptr : entry.make(setup);
  BeliefTrack track;
  track.name = entry.title;
  (by_step ? experiments::EstimatorRunner(*by_step) : entry.runner(setup))
      .run_estimator(
          run, [&](std::size_t k) { return experiments::noisy(run, noise, levels, k); },
          [&](std::size_t /*k*/, const Belief& belief) {
            add_belief(track, by_step.get(), belief);
          });
  return track;
}

}  // namespace

models::RobotModel recorded_robot(const logs::Recording& recording) {
  return scenarios::compile_robot(recorded_scenario(recording));
}

experiments::FittedModels read_models(const fs::path& directory,
                                      const experiments::Experiment& experiment,
                                      const std::string& simulator,
                                      const std::vector<std::string>& estimators) {
  experiments::TunedHyperparameters chosen =
      experiments::or_given(experiments::read_chosen(directory), experiment);
  experiments::FittedModels models;
  for (const std::string& estimator : estimators) {
    experiments::FittedModel& model = models[simulator][estimator];
    if (experiments::estimator_entry(experiment, estimator).fits()) {
      static_cast<Model&>(model) =
          load_model(directory / "models" / experiments::model_name(simulator, estimator));
    }
    model.hyperparameters = chosen[simulator][estimator];
  }
  return models;
}

void add_belief(BeliefTrack& track, const ContactEstimator* estimator, const Belief& belief) {
  const Evidence::Transition transition =
      estimator == nullptr ? Evidence::Transition() : estimator->evidence().transition;
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    track.p_contact[wheel].push_back(static_cast<float>(belief.wheel[wheel].p_contact));
    track.contact[wheel].push_back(belief.wheel[wheel].contact ? 1 : 0);
    if (std::isnan(transition.p_takeoff)) continue;
    track.p_takeoff[wheel].push_back(static_cast<float>(transition.p_takeoff));
    track.p_landing[wheel].push_back(static_cast<float>(transition.p_landing));
  }
}

FilmedRun filmed(logs::Recording recording, const experiments::Experiment& experiment,
                 const noise::SensorProfile& profile, const std::vector<std::string>& estimators,
                 const experiments::FittedModels& models, const noise::SensorNoise& levels) {
  const std::int64_t run = recording.info.run;
  const noise::NoiseKey key = experiments::noise_key(experiment, 0, run);
  logs::Recording reported = recording;
  const scenarios::Scenario scenario = recorded_scenario(recording);
  const experiments::RunSignals signals = experiments::reported_signals(
      profile, experiment, *scenarios::CompiledScenes().as_described(scenario), reported);
  const experiments::NoiseRun drawn = experiments::noise_run(signals, key);
  const std::string& simulator = recording.info.simulator;
  std::vector<BeliefTrack> beliefs;
  for (const std::string& estimator : estimators) {
    beliefs.push_back(
        beliefs_of(experiment, {simulator, simulator, estimator}, models, signals, drawn, levels));
    beliefs.back().colour = line_colour(line_type_of(experiment.estimators, estimator));
  }
  models::RobotModel robot = scenarios::compile_robot(scenario);
  // Torques become those that the sensors report; ground truth and pose stay.
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    for (std::size_t servo = 0; servo < models::servo_count; ++servo) {
      const double torque = reported.observation[k].servo[servo].torque;
      if (std::isfinite(torque)) recording.observation[k].servo[servo].torque = torque;
    }
    recording.observation[k] = noise::with_noise(recording.observation[k], key, k, levels);
  }
  return {std::move(robot), std::move(recording), std::move(beliefs), experiment.labels};
}

std::vector<FilmedRun> filmed_runs(const ReportSubject& subject) {
  const experiments::Experiment& experiment = subject.experiment;
  const noise::SensorProfile profile = experiments::profile_of(
      experiments::read_sensors(experiment, subject.directory), experiment.sensors);
  const experiments::VideoConfig& video = experiment.video;
  const noise::SensorNoise levels = video.noise.levels();
  std::vector<std::string> shown = video.estimators;
  std::erase_if(shown, [&](const std::string& name) {
    const experiments::MakeMethod& making = experiments::estimator_entry(experiment, name).making;
    if (making.whole_run || making.by_step != nullptr) return false;
    print_message(
        fmt::format("touchdown: {}: left out of films and replay: it is written in "
                    "Python; `python3 -m touchdown run {}` shows it\n",
                    name, (subject.directory / "config.yaml").string()));
    return true;
  });
  std::vector<FilmedRun> all;
  for (const TableRow& run : subject.tables.runs.all()) {
    const std::string role(experiments::to_text(experiments::RunRole::test));
    if (run.text("role") != role || run.number("run") != video.run) continue;
    const std::string simulator = run.text("simulator");
    const fs::path log =
        subject.directory / "recordings" /
        experiments::recording_name(simulator, run.text("scenario"), role, video.run);
    if (!is_there(log)) continue;
    const experiments::FittedModels models =
        read_models(subject.directory, experiment, simulator, shown);
    all.push_back(filmed(logs::read_recording(log), experiment, profile, shown, models, levels));
  }
  return all;
}

FilmedRun filmed_recording(const fs::path& log, std::vector<std::string>& warnings,
                           const std::atomic<bool>* stop) {
  logs::LogReader reader(log, stop);
  logs::Recording recording = logs::read_recording(reader, &warnings);
  if (stop != nullptr && *stop) throw Stopped("stopped; nothing was written");
  models::RobotModel robot = recorded_robot(recording);
  return {std::move(robot), std::move(recording), {}, {}};
}

std::function<void(int done, int of)> film_progress(const std::string& what,
                                                    const std::atomic<bool>* stop) {
  // A function object must be copyable, and a bar is not.
  return [what, stop, bar = std::make_shared<std::optional<Progress>>()](int, int frames) {
    // The number of frames is known only now.
    if (!*bar) bar->emplace(what, "frames", frames);
    (*bar)->advance();
    stop_if_asked(stop);
  };
}

}  // namespace touchdown::render
