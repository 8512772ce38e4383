// A robot's program: contact estimation takes ten lines. ROBOT.npz holds the robot's legs and
// masses, which `touchdown convert robot.yaml -o ROBOT.npz` wrote, or a fitted model.

#include <touchdown/estimator.hpp>
#include <touchdown/load_estimator.hpp>

#include "made_up_robot.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return usage("robot ROBOT.npz");
  const auto estimator =
      touchdown::load_estimator(argv[1], {.sample_rate = rate, .robot = "upkie"});
  touchdown::SignalAssembler assembler({.sample_rate = rate});
  MadeUpRobot robot;
  while (robot.is_on()) {
    const touchdown::RobotRecord& record = robot.read();
    const touchdown::Belief& belief = estimator->update(assembler.assemble(record));
    robot.take(belief, assembler.faults());
  }
  return robot.report();
}
