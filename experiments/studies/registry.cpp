#include "experiments/studies/registry.hpp"

#include <utility>

namespace touchdown::experiments {

const std::vector<std::unique_ptr<const Study>>& studies() {
  static const auto all = [] {
    std::vector<std::unique_ptr<const Study>> made;
    for (const auto make : {cross_simulator_study, benchmark_study, odometry_study,
                            closed_loop_study, moments_study, vary_study, ablation_study}) {
      made.push_back(make());
    }
    return made;
  }();
  return all;
}

std::vector<StudySection> study_sections() {
  std::vector<StudySection> sections;
  for (const auto& study : studies()) {
    if (std::optional<StudySection> section = study->section()) {
      sections.push_back(std::move(*section));
    }
  }
  return sections;
}

std::vector<const Study*> requested_studies(const Experiment& experiment) {
  std::vector<const Study*> requested;
  for (const auto& study : studies()) {
    if (study->is_requested(experiment)) requested.push_back(study.get());
  }
  return requested;
}

}  // namespace touchdown::experiments
