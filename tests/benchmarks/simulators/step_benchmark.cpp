// Overhead of a step of a simulated scenario over the engine's own step in the same scene, with the
// same torques in the same states, bit by bit.

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <benchmark/benchmark.h>

#include "scenarios/engine.hpp"
#include "scenarios/start_pose.hpp"
#include "simulators/bullet.hpp"
#include "simulators/collision_model.hpp"

namespace touchdown::simulators {
namespace {

scenarios::Scenario stairs() {
  scenarios::Scenario scenario = scenarios::scenario_from_yaml(
      YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/scenarios/stairs.yaml"));
  scenario.robot = TOUCHDOWN_SOURCE_DIR "/models/upkie.xml";
  return scenario;
}

std::shared_ptr<models::RobotModel> compiled(const scenarios::Scenario& scenario) {
  return std::make_shared<models::RobotModel>(
      models::compile_robot_model(scenario.robot, scenario.terrain));
}

/// Torques on the joints by step: those of the servos and the rolling resistance.
std::vector<JointTorques> torques_of(const logs::Recording& recording, double rolling_resistance) {
  std::vector<JointTorques> torques(recording.steps() - 1);
  for (std::size_t k = 0; k + 1 < recording.steps(); ++k) {
    for (std::size_t i = 0; i < models::servo_count; ++i) {
      torques[k][i] = recording.observation[k + 1].servo[i].torque;
    }
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      const std::size_t servo = models::index(models::wheel_servos[wheel]);
      torques[k][servo] += -rolling_resistance * recording.truth[k].wheel_normal_force[wheel] *
                           std::tanh(recording.observation[k].servo[servo].velocity);
    }
  }
  return torques;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// MuJoCo alone: `mj_step` with the torques written into its own array.
double bare_mujoco(const scenarios::Scenario& scenario, const std::vector<JointTorques>& torques,
                   Eigen::Vector3d& end) {
  const std::shared_ptr<models::RobotModel> robot = compiled(scenario);
  const models::MjModelPtr model = collision_model(*robot->mj);
  model->opt.timestep = 1e-6 * static_cast<double>(scenario.simulation.steps.physics_us);
  for (int geom = 0; geom < model->ngeom; ++geom) {
    model->geom_solref[mjNREF * geom] = scenario.simulation.contact.solref_time_constant;
    model->geom_solref[mjNREF * geom + 1] = scenario.simulation.contact.solref_damping_ratio;
  }
  const models::MjDataPtr data(mj_makeData(model.get()));
  const RobotState at_rest = scenarios::start_pose(*robot, scenario.terrain, scenario.start);
  models::write_pose(*robot, at_rest.position, at_rest.orientation, at_rest.joint_position,
                     data->qpos);
  const auto start = std::chrono::steady_clock::now();
  for (const JointTorques& torque : torques) {
    for (std::size_t i = 0; i < models::servo_count; ++i) {
      data->qfrc_applied[robot->dof_address[i]] = torque[i];
    }
    mj_step(model.get(), data.get());
  }
  const double seconds = seconds_since(start);
  end = {data->qpos[0], data->qpos[1], data->qpos[2]};
  return seconds;
}

/// Bullet alone: `stepSimulation` with the torques added to its links.
class BareBullet : public BulletSimulator {
 public:
  using BulletSimulator::BulletSimulator;

  double run(const std::vector<JointTorques>& torques, Eigen::Vector3d& end) {
    btMultiBody& robot = bullet().robot();
    std::array<int, models::servo_count> link = {};
    for (std::size_t i = 0; i < models::servo_count; ++i) {
      link[i] = bullet().link_of(model().joint[i]);
    }
    const auto start = std::chrono::steady_clock::now();
    for (const JointTorques& torque : torques) {
      for (std::size_t i = 0; i < models::servo_count; ++i)
        robot.addJointTorque(link[i], torque[i]);
      bullet().world().stepSimulation(physics_period(), 0);
    }
    const double seconds = seconds_since(start);
    RobotState state;
    read(state);
    end = state.position;
    return seconds;
  }
};

double bare_bullet(const scenarios::Scenario& scenario, const std::vector<JointTorques>& torques,
                   Eigen::Vector3d& end) {
  const std::shared_ptr<models::RobotModel> robot = compiled(scenario);
  BareBullet simulator(robot, scenario.simulation);
  simulator.reset(scenarios::start_pose(*robot, scenario.terrain, scenario.start));
  return simulator.run(torques, end);
}

/// Runs the scenario and the bare engine in turn under the same load; the fastest counts.
void step(benchmark::State& state, const char* engine) {
  const scenarios::Scenario scenario = stairs();
  const auto simulator = scenarios::make_simulator(scenario, engine);
  const logs::Recording recording = scenarios::play(scenario, *simulator);
  const std::vector<JointTorques> torques =
      torques_of(recording, scenario.simulation.contact.rolling_resistance);
  const auto steps = static_cast<double>(torques.size());
  double scenario_time = 1e9;
  double bare = 1e9;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    const logs::Recording again = scenarios::play(scenario, *simulator);
    const double seconds = seconds_since(start);
    state.SetIterationTime(seconds);
    scenario_time = std::min(scenario_time, seconds);
    Eigen::Vector3d end;
    bare = std::min(bare, engine == std::string("mujoco") ? bare_mujoco(scenario, torques, end)
                                                          : bare_bullet(scenario, torques, end));
    if (end != again.truth.back().base_position) {
      throw std::logic_error("the bare engine ended in another state");
    }
  }
  state.counters["scenario_us"] = 1e6 * scenario_time / steps;
  state.counters["bare_us"] = 1e6 * bare / steps;
  state.counters["overhead_percent"] = 100.0 * (scenario_time / bare - 1.0);
  state.counters["steps_per_second"] = steps / scenario_time;
}
BENCHMARK_CAPTURE(step, mujoco, "mujoco")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->MinTime(4.0);
BENCHMARK_CAPTURE(step, bullet, "bullet")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->MinTime(4.0);

/// Overhead of Upkie's actuators over ideal ones: both robots descend the same stairs in turn; the
/// fastest of each counts.
void actuators(benchmark::State& state, const char* engine) {
  struct TimedRun {
    scenarios::Scenario scenario;
    std::unique_ptr<Simulator> simulator;
    double step = 1e9;  // s

    explicit TimedRun(const char* robot) : scenario(stairs()) { scenario.robot = robot; }
    void again() {
      const auto start = std::chrono::steady_clock::now();
      const logs::Recording recording = scenarios::play(scenario, *simulator);
      step = std::min(step, seconds_since(start) / static_cast<double>(recording.steps()));
    }
  };
  TimedRun ideal(TOUCHDOWN_SOURCE_DIR "/models/upkie.xml");
  TimedRun actuated(TOUCHDOWN_SOURCE_DIR "/models/upkie_actuated.yaml");
  for (TimedRun* run : {&ideal, &actuated}) {
    run->simulator = scenarios::make_simulator(run->scenario, engine);
  }
  for (auto _ : state) {
    ideal.again();
    actuated.again();
  }
  state.counters["ideal_us"] = 1e6 * ideal.step;
  state.counters["actuated_us"] = 1e6 * actuated.step;
  state.counters["percent"] = 100.0 * (actuated.step / ideal.step - 1.0);
}
BENCHMARK_CAPTURE(actuators, mujoco, "mujoco")->Unit(benchmark::kMillisecond)->Iterations(15);
BENCHMARK_CAPTURE(actuators, bullet, "bullet")->Unit(benchmark::kMillisecond)->Iterations(15);

/// Compiles robot and terrain and loads them into an engine: once per run, or once for many runs.
void compile_scene(benchmark::State& state, const char* engine) {
  const scenarios::Scenario scenario = stairs();
  for (auto _ : state) benchmark::DoNotOptimize(scenarios::make_simulator(scenario, engine));
}
BENCHMARK_CAPTURE(compile_scene, mujoco, "mujoco")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compile_scene, bullet, "bullet")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace touchdown::simulators
