#include "experiments/studies/moments/config.hpp"

#include "experiments/config/experiment_yaml.hpp"

namespace touchdown::experiments {

StudySection moments_section() {
  return {
      .key = "moments", .describe = [](Fields& fields, Experiment& experiment) {
        bool is_requested = experiment.studies.has<MomentsConfig>();
        if (!fields.present("moments", is_requested)) return;
        fields("moments", is_requested).doc("Whether torques are compared with the real robot's.");
        if (is_requested) experiment.studies.emplace<MomentsConfig>();
      }};
}

}  // namespace touchdown::experiments
