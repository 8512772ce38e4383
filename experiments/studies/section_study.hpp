#pragma once

#include "experiments/config/experiment_yaml.hpp"
#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// A study that an experiment file asks for by having its section.
template <typename Section>
class SectionStudy : public Study {
 public:
  bool is_requested(const Experiment& experiment) const final {
    return experiment.studies.has<Section>();
  }

 protected:
  static const Section& section_of(const Experiment& experiment) {
    return experiment.studies.at<Section>();
  }
};

}  // namespace touchdown::experiments
