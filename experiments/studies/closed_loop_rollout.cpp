#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/plan/plan.hpp"
#include "experiments/plan/request.hpp"
#include "experiments/signals/run_signals.hpp"
#include "experiments/studies/closed_loop.hpp"
#include "logs/signals_from.hpp"
#include "noise/reported_signals.hpp"
#include "noise/sensor_noise.hpp"
#include "policies/wheel_contact.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/leg_geometry.hpp"
#include "scenarios/rollout.hpp"
#include "scoring/score.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::experiments {

namespace {

/// An estimator in the loop: sensors and noise between it and the robot, and its state between
/// control steps.
struct LoopState {
  std::unique_ptr<ContactEstimator> estimator;
  noise::SensorProfile profile;
  noise::NoiseKey sensor_draws;  ///< of the random parts of the profile
  noise::ReportingSensors sensors;
  noise::SensorNoise levels;  ///< added to the output of the sensors
  noise::NoiseKey noise_draws;
  std::uint64_t step = 0;
  Belief belief = {};
};

/// Records beliefs in `trace`, and returns their decisions.
std::array<bool, models::wheel_count> record(
    const std::array<WheelBelief, models::wheel_count>& beliefs, ContactTrace& trace) {
  std::array<bool, models::wheel_count> in_contact = {};
  for (std::size_t wheel = 0; wheel < in_contact.size(); ++wheel) {
    in_contact[wheel] = beliefs[wheel].contact;
    trace.contact[wheel].push_back(beliefs[wheel].contact ? 1 : 0);
    trace.p_contact[wheel].push_back(static_cast<float>(beliefs[wheel].p_contact));
  }
  return in_contact;
}

/// Makes an estimator the contact source of a policy. At every control step it receives the signals
/// of an offline evaluation of this run, so that both give the same decisions. At a step without a
/// record the last belief holds. `trace` records the contact and must outlive the result.
policies::WheelContact contact_source(LoopState loop, ContactTrace& trace) {
  loop.estimator->reset();
  const auto state = std::make_shared<LoopState>(std::move(loop));
  return [state, &trace](const models::Observation& observation, const models::Action* previous) {
    models::Observation reported = observation;
    state->sensors.report(std::span(&reported, 1));
    if (!std::isnan(reported.time)) {
      reported = noise::with_noise(reported, state->noise_draws, state->step, state->levels);
      std::optional<models::Action> action;
      if (previous != nullptr) {
        action = *previous;
        noise::report_targets(state->profile, state->sensor_draws, std::span(&*action, 1));
      }
      state->belief =
          state->estimator->update(logs::signals_from(reported, action ? &*action : nullptr));
    }
    ++state->step;
    return record(state->belief.wheel, trace);
  };
}

/// Another contact source, recorded in `trace`, which must outlive the result.
policies::WheelContact recorded(policies::WheelContact contact, ContactTrace& trace) {
  return [contact = std::move(contact), &trace](const models::Observation& observation,
                                                const models::Action* previous) {
    const auto [left, right] = contact(observation, previous);
    return record({{{left ? 1.0 : 0.0, left}, {right ? 1.0 : 0.0, right}}}, trace);
  };
}

/// The estimator with the model that was fitted in this engine.
std::unique_ptr<ContactEstimator> estimator_of(const Experiment& experiment,
                                               const ClosedLoopCell& cell,
                                               const FittedModels& models, EstimatorSetup setup) {
  const EstimatorEntry entry =
      entry_of(experiment, {cell.simulator, cell.simulator, cell.contact}, models);
  setup.model = entry.fits() ? &models.at(model_key(cell.simulator, {})).at(entry.name) : nullptr;
  return entry.make(setup);
}

double ratio(double sum, std::int64_t count) {
  return count > 0 ? sum / static_cast<double>(count) : std::nan("");
}

odometry::LegJoints joints_of(const models::Observation& observation, std::size_t leg) {
  odometry::LegJoints joints;
  for (std::size_t i = 0; i < joints.position.size(); ++i) {
    const models::ServoReading& servo = observation.servo[joints.position.size() * leg + i];
    joints.position[i] = servo.position;
    joints.velocity[i] = servo.velocity;
  }
  return joints;
}

/// Steps at which a wheel lands after a flight of at least `shortest` steps.
std::vector<std::size_t> landings(const scoring::ContactSequence& contact, std::size_t shortest) {
  std::vector<std::size_t> steps;
  for (const scoring::Flight& flight : scoring::flights(contact)) {
    const bool lands = flight.takeoff > 0 && flight.landing < contact.size();
    if (lands && flight.landing - flight.takeoff >= shortest) steps.push_back(flight.landing);
  }
  return steps;
}

}  // namespace

ClosedLoopRun run_closed_loop(const RunRequest& request, const ClosedLoopCell& cell,
                              std::int64_t run, const FittedModels& models,
                              scenarios::CompiledScenes& scenes,
                              const ShouldContinue& should_continue) {
  const Experiment& experiment = request.experiment;
  scenarios::Scenario scenario = scenario_of(request, cell);
  if (experiment.test.perturbed) scenario = scenarios::perturbed(scenario, experiment.seed, run);
  const auto simulator = scenarios::make_simulator(scenario, cell.simulator, scenes.of(scenario));
  const double period = simulator->control_period();
  ClosedLoopRun loop;
  policies::WheelContact source;
  if (cell.is_oracle() || cell.contact == "always") {
    scenarios::Scenario undelayed = scenario;
    undelayed.policy.delay = 0.0;
    source = recorded(scenarios::policy_contact(undelayed, *simulator), loop.trace);
  } else {
    const EstimatorSetup setup{.sample_rate = 1.0 / period,
                               .legs = scenarios::leg_geometry(*scenes.as_described(scenario))};
    const noise::SensorProfile profile = profile_of(request.sensors, experiment.sensors);
    const noise::NoiseKey draws = sensor_key(experiment, run);
    source = contact_source({estimator_of(experiment, cell, models, setup), profile, draws,
                             noise::ReportingSensors(profile, draws, period), cell.noise.levels(),
                             noise_key(experiment, 0, run)},
                            loop.trace);
  }
  loop.recording = scenarios::play(
      scenario, *simulator, experiment.seed, run,
      [&](double /*time*/) { return should_continue(); }, std::move(source));
  if (!should_continue()) throw Stopped();
  loop.scenario = std::move(scenario);
  return loop;
}

double ClosedLoopMetrics::landing_speed_rms() const {
  return std::sqrt(ratio(squared_landing_speed, landings));
}
double ClosedLoopMetrics::mean_largest_pitch() const { return ratio(largest_pitch, runs); }
double ClosedLoopMetrics::mean_largest_force() const { return ratio(largest_force, runs); }
double ClosedLoopMetrics::false_takeoffs_per_minute() const {
  return 60e6 * ratio(static_cast<double>(false_takeoffs), contact_us);
}

ClosedLoopMetrics& ClosedLoopMetrics::operator+=(const ClosedLoopMetrics& other) {
  runs += other.runs;
  finished += other.finished;
  fell += other.fell;
  landings += other.landings;
  squared_landing_speed += other.squared_landing_speed;
  largest_pitch += other.largest_pitch;
  largest_force += other.largest_force;
  false_takeoffs += other.false_takeoffs;
  contact_us += other.contact_us;
  return *this;
}

std::array<double, models::wheel_count> tyre_speeds(const models::Observation& observation,
                                                    const models::GroundTruth& truth,
                                                    const odometry::WheeledBiped& robot) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d base = truth.base_orientation.toRotationMatrix();
  const Eigen::Vector3d rate = base.transpose() * truth.base_angular_velocity;
  Eigen::Vector3d heading = base.col(0);
  heading.z() = 0.0;
  heading.normalize();
  std::array<double, models::wheel_count> speeds = {};
  for (std::size_t leg = 0; leg < speeds.size(); ++leg) {
    const odometry::WheelMotion wheel = motion_of(robot.leg[leg], joints_of(observation, leg));
    const Eigen::Vector3d axle =
        truth.imu_linear_velocity + base * (rate.cross(wheel.centre) + wheel.velocity);
    const Eigen::Vector3d spin = base * (rate + wheel.spin * Eigen::Vector3d::UnitY());
    speeds[leg] = heading.dot(robot.wheel_radius * spin.cross(up) - axle);
  }
  return speeds;
}

ClosedLoopMetrics closed_loop_metrics_of(
    const logs::Recording& recording,
    const std::array<scoring::ContactSequence, models::wheel_count>& trace,
    const odometry::WheeledBiped& robot, const scoring::LabelConfig& labels,
    const scoring::ScoringConfig& scoring) {
  ClosedLoopMetrics metrics;
  metrics.runs = 1;
  const auto how = recording.info.outcome.value_or(logs::Outcome::finished);
  metrics.finished = how == logs::Outcome::finished ? 1 : 0;
  metrics.fell = is_failure(how) ? 1 : 0;
  const double period = recording.period();
  const auto shortest = static_cast<std::size_t>(std::llround(scoring.minimum_flight / period));
  const auto contact = scoring::contact_labels(recording, labels);
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    for (const std::size_t step : landings(contact[wheel], shortest)) {
      // The step before the landing: the ground has not changed the wheel's speed yet.
      const double speed =
          tyre_speeds(recording.observation[step - 1], recording.truth[step - 1], robot)[wheel];
      metrics.landings += 1;
      metrics.squared_landing_speed += speed * speed;
    }
  }
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    const auto& force = recording.truth[k].wheel_normal_force;
    metrics.largest_force = std::max({metrics.largest_force, force[0], force[1]});
    metrics.largest_pitch =
        std::max(metrics.largest_pitch, std::abs(recording.observation[k].pitch));
  }
  const scoring::ContactSequence robot_contact = scoring::any_wheel(contact);
  for (const scoring::JudgedTransition& judged :
       judge_transitions(robot_contact, scoring::any_wheel(trace), period, scoring)) {
    const bool is_false_takeoff = judged.kind == scoring::EventKind::takeoff &&
                                  judged.verdict == scoring::Judgement::false_alarm;
    metrics.false_takeoffs += is_false_takeoff ? 1 : 0;
  }
  metrics.contact_us = recording.info.control_period_us * std::ranges::count(robot_contact, 1);
  return metrics;
}

ClosedLoopMetrics measure_closed_loop(const RunRequest& request, std::size_t run,
                                      const FittedModels& models, scenarios::CompiledScenes& scenes,
                                      const ShouldContinue& should_continue) {
  const Experiment& experiment = request.experiment;
  const auto of_cell = static_cast<std::size_t>(experiment.studies.at<ClosedLoopConfig>().runs);
  const ClosedLoopCell cell = closed_loop_cells(experiment)[run / of_cell];
  try {
    const ClosedLoopRun loop = run_closed_loop(
        request, cell, static_cast<std::int64_t>(run % of_cell), models, scenes, should_continue);
    return closed_loop_metrics_of(loop.recording, loop.trace.contact,
                                  wheeled_biped(*scenes.as_described(loop.scenario)),
                                  experiment.labels, experiment.scoring);
  } catch (const InputError&) {
    throw;
  } catch (const Stopped&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;  // no failure of the run
  } catch (const std::exception&) {
    return {.runs = 1, .fell = 1};
  }
}

}  // namespace touchdown::experiments
