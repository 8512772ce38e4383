#include "estimator/bayes/ablation.hpp"

#include <vector>

namespace touchdown {

namespace {

/// One change: what a step takes over from `robust`.
struct Change {
  const char* name;
  const char* text;
  void (*apply)(BayesFilterConfig& config, const BayesFilterConfig& robust);
};

constexpr Change changes[] = {
    {"paper_low_pass", "torques low-passed at 25 ms",
     [](BayesFilterConfig& config, const BayesFilterConfig& robust) {
       config.measurement.torque.low_pass = robust.measurement.torque.low_pass;
     }},
    {"paper_grid", "a grid that covers all samples",
     [](BayesFilterConfig& config, const BayesFilterConfig& robust) {
       config.measurement.fit.knee_range = robust.measurement.fit.knee_range;
       config.measurement.fit.wheel_range = robust.measurement.fit.wheel_range;
     }},
    {"paper_bandwidth", "bandwidths of at least 0.01 N·m",
     [](BayesFilterConfig& config, const BayesFilterConfig& robust) {
       config.measurement.fit.bandwidth_floor = robust.measurement.fit.bandwidth_floor;
     }},
    {"paper_noise", "densities that follow the sensors' noise",
     [](BayesFilterConfig& config, const BayesFilterConfig& robust) {
       config.measurement.noise = robust.measurement.noise;
     }},
    {"paper_floor", "a floor under the likelihood of contact",
     [](BayesFilterConfig& config, const BayesFilterConfig& robust) {
       config.measurement.contact_floor = robust.measurement.contact_floor;
     }},
    {"paper_switch", "the authors' code's sigmoid of the power",
     [](BayesFilterConfig& config, const BayesFilterConfig& robust) {
       config.transition.switch_sigmoid = robust.transition.switch_sigmoid;
     }},
    {"paper_landing", "the authors' code's sigmoid of the median frequency",
     [](BayesFilterConfig& config, const BayesFilterConfig& robust) {
       config.transition.landing_sigmoid = robust.transition.landing_sigmoid;
     }},
    {"paper_memory", "a memory of the median frequency",
     [](BayesFilterConfig& config, const BayesFilterConfig& robust) {
       config.transition.median_memory = robust.transition.median_memory;
     }},
    {"paper_margin", "a margin between both sigmoids and certainty",
     [](BayesFilterConfig& config, const BayesFilterConfig& robust) {
       config.transition.margin = robust.transition.margin;
     }},
};

}  // namespace

std::span<const AblationStep> steps_from_paper_to_robust() {
  static const std::vector<AblationStep> steps = [] {
    std::vector<AblationStep> all;
    BayesFilterConfig config = BayesFilterConfig::paper();
    for (const Change& change : changes) {
      change.apply(config, BayesFilterConfig::robust());
      all.push_back({change.name, change.text, config});
    }
    return all;
  }();
  return steps;
}

}  // namespace touchdown
