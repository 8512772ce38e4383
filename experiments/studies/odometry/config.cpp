#include "experiments/studies/odometry/config.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "experiments/config/experiment_yaml.hpp"

namespace touchdown::experiments {

static void describe(Fields& fields, OdometryStudyConfig& odometry,
                     const Experiment& /*experiment*/) {
  fields.in_line("delay", odometry.delay)
      .range("above 0, to 1")
      .doc("s", "Delays of true contact; odometry runs with each.");
  for (auto delay = odometry.delay.begin(); delay != odometry.delay.end(); ++delay) {
    fields.check(*delay > 0.0 && *delay <= 1.0, "delay", "expected times between 0 and 1 s");
    fields.check(std::find(odometry.delay.begin(), delay, *delay) == delay, "delay",
                 fmt::format("{} appears twice", *delay));
  }
}

StudySection odometry_section() {
  return optional_section<OdometryStudyConfig>("odometry",
                                               "Odometry on every test run, by contact source.");
}

}  // namespace touchdown::experiments
