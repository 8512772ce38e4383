#include "experiments/plan/needs.hpp"

#include <cmath>

namespace touchdown::experiments {

void add_runs(Needs& needs, const scenarios::Scenario& scenario, double runs, double seeds,
              double sensors) {
  // Runs that end at a position take about half of their longest duration.
  const double share = std::isfinite(scenario.end.x) ? 0.5 : 1.0;
  const double seconds = runs * share * scenario.end.duration;
  needs.runs += runs;
  needs.parts += runs * seeds * sensors;
  needs.seconds += seconds;
  needs.steps +=
      sensors * seconds / (1e-6 * static_cast<double>(scenario.simulation.steps.control_us));
}

}  // namespace touchdown::experiments
