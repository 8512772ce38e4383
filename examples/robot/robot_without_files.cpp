// The same for a robot without a file system: its legs and masses are compiled in.

#include <touchdown/estimator.hpp>

#include "made_up_robot.hpp"
#include MODEL_HEADER  // written by `touchdown convert robot.yaml -o model.hpp`

int main() {
  const auto estimator = touchdown::make_estimator(touchdown::compiled::model,
                                                   {.sample_rate = rate, .robot = "upkie"});
  touchdown::SignalAssembler assembler({.sample_rate = rate});
  MadeUpRobot robot;
  while (robot.is_on()) {
    const touchdown::RobotRecord& record = robot.read();
    const touchdown::Belief& belief = estimator->update(assembler.assemble(record));
    robot.take(belief, assembler.faults());
  }
  return robot.report();
}
