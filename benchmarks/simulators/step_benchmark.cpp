// What a step of a played scenario costs over the engine's own step in the same scene: the same
// torques in the same states, bit by bit, with nothing else around.

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <benchmark/benchmark.h>

#include "scenarios/engine.hpp"
#include "scenarios/start_pose.hpp"
#include "simulators/bullet/simulator.hpp"
#include "simulators/bullet/world.hpp"
#include "simulators/mujoco_simulator.hpp"

namespace touchdown::simulators {
namespace {

scenarios::Scenario stairs() {
  scenarios::Scenario scenario =
      scenarios::load_scenario(TOUCHDOWN_SOURCE_DIR "/scenarios/stairs.yaml");
  scenario.robot = TOUCHDOWN_SOURCE_DIR "/models/upkie.xml";
  return scenario;
}

std::shared_ptr<models::RobotModel> compiled(const scenarios::Scenario& scenario) {
  return std::make_shared<models::RobotModel>(
      models::compile_robot_model(scenario.robot, scenario.terrain));
}

/// Every torque that acted on a joint, step by step: the servo's and the rolling resistance.
std::vector<JointTorques> torques_of(const recordings::Recording& recording,
                                     double rolling_resistance) {
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
  MujocoSimulator mujoco(robot, scenario.simulation);
  mujoco.reset(scenarios::start_pose(*robot, scenario.terrain, scenario.start));
  const mjModel& model = mujoco.engine_model();
  const models::MjDataPtr data(mj_makeData(&model));
  mju_copy(data->qpos, mujoco.engine_data().qpos, model.nq);
  mju_copy(data->qvel, mujoco.engine_data().qvel, model.nv);
  const auto start = std::chrono::steady_clock::now();
  for (const JointTorques& torque : torques) {
    for (std::size_t i = 0; i < models::servo_count; ++i) {
      data->qfrc_applied[robot->dof_address[i]] = torque[i];
    }
    mj_step(&model, data.get());
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
    for (std::size_t i = 0; i < models::servo_count; ++i) link[i] = bullet().link_of(i);
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

/// Played and bare in turn, so that whatever else the machine does meets both; the fastest counts.
void step(benchmark::State& state, const char* engine) {
  const scenarios::Scenario scenario = stairs();
  const auto simulator = scenarios::make_simulator(scenario, engine);
  const recordings::Recording recording = scenarios::play(scenario, *simulator);
  const std::vector<JointTorques> torques =
      torques_of(recording, scenario.simulation.contact.rolling_resistance);
  const auto steps = static_cast<double>(torques.size());
  double played = 1e9;
  double bare = 1e9;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    const recordings::Recording again = scenarios::play(scenario, *simulator);
    const double seconds = seconds_since(start);
    state.SetIterationTime(seconds);
    played = std::min(played, seconds);
    Eigen::Vector3d end;
    bare = std::min(bare, engine == std::string("mujoco") ? bare_mujoco(scenario, torques, end)
                                                          : bare_bullet(scenario, torques, end));
    if (end != again.truth.back().base_position) {
      throw std::logic_error("the bare engine did not go the same way");
    }
  }
  state.counters["played_us"] = 1e6 * played / steps;
  state.counters["bare_us"] = 1e6 * bare / steps;
  state.counters["overhead_percent"] = 100.0 * (played / bare - 1.0);
  state.counters["steps_per_second"] = steps / played;
}
BENCHMARK_CAPTURE(step, mujoco, "mujoco")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->MinTime(4.0);
BENCHMARK_CAPTURE(step, bullet, "bullet")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->MinTime(4.0);

/// What Upkie's actuators cost over ideal ones: both robots come down the same stairs in turn; the
/// fastest of each counts.
void actuators(benchmark::State& state, const char* engine) {
  struct Played {
    scenarios::Scenario scenario;
    std::unique_ptr<Simulator> simulator;
    double step = 1e9;  // s

    explicit Played(const char* robot) : scenario(stairs()) { scenario.robot = robot; }
    void again() {
      const auto start = std::chrono::steady_clock::now();
      const recordings::Recording recording = scenarios::play(scenario, *simulator);
      step = std::min(step, seconds_since(start) / static_cast<double>(recording.steps()));
    }
  };
  Played ideal(TOUCHDOWN_SOURCE_DIR "/models/upkie.xml");
  Played actuated(TOUCHDOWN_SOURCE_DIR "/models/upkie_actuated.yaml");
  for (Played* played : {&ideal, &actuated}) {
    played->simulator = scenarios::make_simulator(played->scenario, engine);
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

/// Robot and terrain compiled and put into an engine: once per run, or once per many.
void compile_scene(benchmark::State& state, const char* engine) {
  const scenarios::Scenario scenario = stairs();
  for (auto _ : state) benchmark::DoNotOptimize(scenarios::make_simulator(scenario, engine));
}
BENCHMARK_CAPTURE(compile_scene, mujoco, "mujoco")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compile_scene, bullet, "bullet")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace touchdown::simulators
