#include "experiments/studies/registry.hpp"

#include "experiments/studies/benchmark/study.hpp"
#include "experiments/studies/closed_loop/study.hpp"
#include "experiments/studies/cross_simulator/study.hpp"
#include "experiments/studies/labels/study.hpp"
#include "experiments/studies/moments/study.hpp"
#include "experiments/studies/odometry/study.hpp"
#include "experiments/studies/operating_points/study.hpp"
#include "experiments/studies/sensor_sweep/study.hpp"

namespace touchdown::experiments {

namespace {

template <typename... Studies>
std::vector<std::unique_ptr<const Study>> listed() {
  std::vector<std::unique_ptr<const Study>> all;
  (all.push_back(std::make_unique<const Studies>()), ...);
  return all;
}

}  // namespace

const std::vector<std::unique_ptr<const Study>>& studies() {
  static const auto all = listed<LabelStudy,            //
                                 CrossSimulatorStudy,   //
                                 MomentsStudy,          //
                                 BenchmarkStudy,        //
                                 OdometryStudy,         //
                                 OperatingPointsStudy,  //
                                 ClosedLoopStudy,       //
                                 SensorSweepStudy>();
  return all;
}

std::vector<const Study*> requested_studies(const Experiment& experiment) {
  std::vector<const Study*> requested;
  for (const auto& study : studies()) {
    if (study->is_requested(experiment)) requested.push_back(study.get());
  }
  return requested;
}

}  // namespace touchdown::experiments
